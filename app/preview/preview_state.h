// SPDX-License-Identifier: BSD-3-Clause
// The state that commands of a preview change, its history for undo, and its scene for `meniscus render`.
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

/// A figure of any size: its scene, and a camera that replaces the scene's. Commands, undo and redo change it.
struct PreviewFigure : Scene {
  PreviewFigure() {
    image.samples = 4;
    image.background = glm::vec3(1.0f);
  }
  /// Takes a scene whose colours have the numbers of their file. The figure keeps only the projection, the size and the
  /// resolution of the scene's view.
  explicit PreviewFigure(Scene scene);

  Camera camera;
  bool overview = true;                         ///< everything is in view, until the camera is moved
  bool has_size = false;                        ///< exported pictures have the size of the scene instead of the page's
  LookPreset preset = LookPreset::publication;  ///< the word that was chosen last; the scene has its light
  std::uint64_t edition = 0;                    ///< a number that changes with the figure, but not with its camera

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
  double hold = 2.0, transition = 2.0;  ///< seconds that the scene is shown, and that the way to the next scene takes
  std::uint64_t number = 0;             ///< identifies the scene on the page

  /// Return the numbers of pictures of the scene and of the way to the next scene at a rate, as `meniscus film` does.
  std::uint64_t held(double rate) const;
  std::uint64_t between(double rate) const;
};

/// Throws RequestError if the scheme, or a rule of it, needs surfaces that a preview does not make.
void require_previewed(const ColorScheme& color);
/// Returns true if previews show the scheme even without numbers of a file.
bool is_previewed(ColorScheme::By scheme);

/// The whole state that commands change. A command makes another state of it; the picture follows from the state.
struct PreviewState : PreviewFigure {
  std::size_t frame = 0;               ///< from 0
  std::map<std::size_t, Camera> keys;  ///< cameras by frame, all of one projection
  bool follows_keys = false;           ///< showing a frame moves the camera along its keys
  bool playing = false;
  double frames_per_second = 10.0;  ///< while playing
  glm::ivec2 size{1024, 768};       ///< size of the full picture with its legend, in pixels
  bool copies_apart = false;        ///< no probe may touch two copies of the structure (Structure::instances)
  std::vector<KeptScene> strip;     ///< scenes kept for a film, in its order
  std::uint64_t last_kept = 0;      ///< the number of the scene that was kept last
  double strip_place = 0.0;         ///< the place on the strip that was shown last
  std::uint64_t strip_shown = 0;    ///< how many pictures of a film that plays have shown the scene at strip_place
  double strip_rate = 25.0;         ///< pictures per second of the strip while it plays
  bool plays_strip = false;         ///< playing goes along the strip, not through the frames
  std::uint64_t revision = 1;       ///< grows with every visible change
  bool ended = false;               ///< true after the command quit

  /// Returns the pictures per second of what plays.
  double rate() const { return plays_strip ? strip_rate : frames_per_second; }
  /// Returns the look of the full picture, its legend included.
  Look full_look() const { return look_of(look, size, shown_background(), hues(), molecule.patches.has_value()); }
};

/// The figures before each step, for undo and redo. Successive steps of one kind without end_step() between them, such
/// as the movements of one drag, are one step.
class EditHistory {
 public:
  /// Keeps the figure before a step of this kind; if the kind is empty, the step is undone alone.
  void note(std::string_view kind, const PreviewFigure& before);
  /// Makes the next step one that is undone alone.
  void end_step() { kind_.clear(); }

  /// Return the figure that undo or redo brings back; nullptr if there is none.
  const PreviewFigure* before() const { return past_.empty() ? nullptr : &past_.back(); }
  const PreviewFigure* after() const { return future_.empty() ? nullptr : &future_.back(); }
  /// Note that before() or after(), which must not be nullptr, replaces the figure `now`.
  void go_back(const PreviewFigure& now) { move(now, past_, future_); }
  void go_forward(const PreviewFigure& now) { move(now, future_, past_); }

  std::size_t undo_steps() const { return past_.size(); }
  std::size_t redo_steps() const { return future_.size(); }

 private:
  void move(const PreviewFigure& now, std::deque<PreviewFigure>& from, std::deque<PreviewFigure>& to);

  std::deque<PreviewFigure> past_, future_;
  std::string kind_;  ///< kind of the last step; empty: the step has ended
};

/// A picture of a figure.
struct RenderedView {
  glm::ivec2 size;  ///< pixels, with the legend
  int samples = 1;
  bool transparent = false;                      ///< true: without a background
  std::optional<std::int32_t> model{};           ///< the model that is shown, if the file has several
  std::optional<std::uint64_t> frame{};          ///< the frame of a trajectory
  std::optional<std::array<double, 2>> range{};  ///< range of the colour scale, if one model alone would have another
};

/// Returns the scene that `meniscus render` draws as this picture.
Scene rendered_scene(const PreviewFigure& figure, const RenderedView& view);

/// Returns a request for a look with these numbers. `asked` gives the values that are not numbers.
LookRequest look_request(LookRequest asked, Look look, bool outlines_patches);

// Pure functions of camera_commands.cpp that turn and place a camera.

/// Returns the height of the picture in Å, in the plane through the target.
double height_at_target(const Camera& camera);

/// Turns a camera about its target like a trackball: the front follows the cursor, the distance stays. drag: to the
/// right and down, in heights of the picture; a drag over the whole height turns the molecule half around.
Camera orbited(const Camera& camera, glm::dvec2 drag);

/// Returns the same view in another projection: objects in the plane of the target keep their size. An orthographic
/// camera is outside of all `balls`, whichever way it turns, since it sees nothing behind its plane.
Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls);

/// Looks in the same direction at all of `shown`, with a small margin, from outside of all `balls` if orthographic.
/// Neither may be empty. aspect: width / height of the picture.
Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect);

/// Returns the default view of at least one ball (frame_camera); all balls stay in view when it is turned.
Camera overview(std::span<const Ball> balls, double aspect, Projection projection);

}  // namespace meniscus
