// SPDX-License-Identifier: BSD-3-Clause
// The state that commands of a preview change, with the steps before it, and as a scene that `meniscus render` draws.
#pragma once

#include "core/camera/camera.h"
#include "core/color/color_schemes.h"
#include "core/render/legend.h"
#include "core/render/look.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/scene/surface_computer.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// A figure, whatever its size on the screen: its scene, and the camera in place of the scene's. Commands change it,
/// undo and redo replace it.
struct PreviewFigure : Scene {
  PreviewFigure() {
    image.samples = 4;
    image.background = glm::vec3(1.0f);
  }
  /// Takes a scene whose colours have the numbers of their file. Of its view only the projection, the size and the
  /// resolution are kept.
  explicit PreviewFigure(Scene scene);

  Camera camera;
  bool overview = true;                         ///< all is shown, until the camera is moved
  bool has_size = false;                        ///< exported pictures have the size of the scene; else that of the page
  LookPreset preset = LookPreset::publication;  ///< the word that was chosen last; the scene has its light
  std::uint64_t edition = 0;                    ///< a number of its own for all that was changed, but for the camera

  /// Returns the changes that light may make to the colours.
  Hues hues() const { return hues_of(molecule.color, uses_atoms(figure.cuts)); }
  /// Returns the background on the screen, sRGB: white if pictures are transparent.
  glm::vec3 shown_background() const { return image.background.value_or(glm::vec3(1.0f)); }
  /// Returns the length in Å by which the balls of the surface are grown.
  double growth() const { return growth_of(molecule.surface.kind, molecule.surface.probe_radius); }
  /// Returns the radius in Å of the probe that rolls over these balls.
  double rolling_radius() const { return rolling_probe(molecule.surface.kind, molecule.surface.probe_radius); }
  /// Returns how far in Å from the atoms' balls something may be and still change their surface.
  double probe_reach() const { return growth() + rolling_radius(); }
};

/// A scene that is kept for a film.
struct KeptScene {
  PreviewFigure figure;
  std::size_t frame = 0;                ///< from 0
  double hold = 2.0, transition = 2.0;  ///< seconds that it is shown, and from it to the next scene
  std::uint64_t number = 0;             ///< a number of its own, by which a page knows it again

  /// Return the numbers of its pictures and of those on the way to the next scene, as `meniscus film` counts them.
  /// rate: pictures per second.
  std::uint64_t held(double rate) const;
  std::uint64_t between(double rate) const;
};

/// Throws RequestError for a scheme whose numbers or parts come with surfaces that a preview does not make; so
/// for those of its rules.
void require_previewed(const ColorScheme& color);
/// Whether it is none of these, whatever a preview was begun with.
bool is_previewed(ColorScheme::By scheme);

/// All that commands change. A command makes another state of it; the picture follows from the state.
struct PreviewState : PreviewFigure {
  std::size_t frame = 0;               ///< from 0
  std::map<std::size_t, Camera> keys;  ///< of the camera, by frame; all of one projection
  bool follows_keys = false;           ///< showing a frame moves the camera along its keys
  bool playing = false;
  double frames_per_second = 10.0;  ///< while playing
  glm::ivec2 size{1024, 768};       ///< of the full picture with its legend, in pixels
  bool copies_apart = false;        ///< no probe may touch two copies of the structure (Structure::instances)
  std::vector<KeptScene> strip;     ///< scenes kept for a film, in its order
  std::uint64_t last_kept = 0;      ///< the number of the scene that was kept last
  double strip_place = 0.0;         ///< of the strip, which was shown last
  std::uint64_t strip_shown = 0;    ///< how many pictures of a film that plays show the scene there
  double strip_rate = 25.0;         ///< pictures per second of the strip while it plays
  bool plays_strip = false;         ///< playing goes along the strip, not through the frames
  std::uint64_t revision = 1;       ///< grows with every change of what is seen
  bool ended = false;               ///< true after the command quit

  /// Returns the pictures per second of what plays.
  double rate() const { return plays_strip ? strip_rate : frames_per_second; }
  /// Returns the look of the full picture, its legend included.
  Look full_look() const { return look_of(look, size, shown_background(), hues(), molecule.patches.has_value()); }
};

/// What a figure was before each step, for undo and redo. Steps of one kind that follow each other without end_step()
/// between them, such as the movements of one drag, are one step.
class EditHistory {
 public:
  /// What was there before a step of this kind; empty: a step by itself.
  void note(std::string_view kind, const PreviewFigure& before);
  /// The next step is one by itself.
  void end_step() { kind_.clear(); }

  /// The figure that undo or redo brings back; nullptr: none.
  const PreviewFigure* before() const { return past_.empty() ? nullptr : &past_.back(); }
  const PreviewFigure* after() const { return future_.empty() ? nullptr : &future_.back(); }
  /// It has been brought back in place of the figure there was. There must be one.
  void go_back(const PreviewFigure& now) { move(now, past_, future_); }
  void go_forward(const PreviewFigure& now) { move(now, future_, past_); }

  std::size_t undo_steps() const { return past_.size(); }
  std::size_t redo_steps() const { return future_.size(); }

 private:
  void move(const PreviewFigure& now, std::deque<PreviewFigure>& from, std::deque<PreviewFigure>& to);

  std::deque<PreviewFigure> past_, future_;
  std::string kind_;  ///< of the last step; empty: it is ended
};

/// A picture of a figure.
struct RenderedView {
  glm::ivec2 size;  ///< pixels, with the legend
  int samples = 1;
  bool transparent = false;                      ///< true: without a background
  std::optional<std::int32_t> model{};           ///< the model that is shown, if the file has several
  std::optional<std::uint64_t> frame{};          ///< the frame of a trajectory
  std::optional<std::array<double, 2>> range{};  ///< of numbers, if those of one model alone would have another
};

/// Returns the scene that `meniscus render` draws as this picture.
Scene rendered_scene(const PreviewFigure& figure, const RenderedView& view);

/// Returns a request for a look with these numbers. `asked` gives the values that are not numbers.
LookRequest look_request(LookRequest asked, Look look, bool outlines_patches);

// How commands turn and place a camera: pure functions (camera_commands.cpp).

/// Å between the lower and upper edge of the picture, in the plane through the target.
double height_at_target(const Camera& camera);

/// Turns about the target as a trackball: the front follows the cursor. drag: in heights of the picture, to the right
/// and down; a drag over the whole height turns the molecule half around. The distance from the target stays.
Camera orbited(const Camera& camera, glm::dvec2 drag);

/// The same view by another projection: what lies in the plane of the target keeps its size. An orthographic camera
/// is outside of all `balls`, whichever way it turns, since it sees nothing behind its plane.
Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls);

/// Looks the same way at all of `shown`, with a small margin, from outside of all `balls` if orthographic. There must
/// be a ball in each. aspect: width / height of the picture.
Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect);

/// The default view of all of the balls (frame_camera), which may be turned any way. There must be a ball.
Camera overview(std::span<const Ball> balls, double aspect, Projection projection);

}  // namespace meniscus
