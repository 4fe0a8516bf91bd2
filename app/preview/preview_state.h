// SPDX-License-Identifier: BSD-3-Clause
// The state that commands of a preview change, with the steps before it, and as a scene that `meniscus render` draws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/color/color_schemes.h"
#include "core/render/legend.h"
#include "core/render/look.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/scene/surface_computer.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Of exported pictures, what a command does not say. Nothing: as it is shown.
struct ExportOptions {
  std::optional<glm::ivec2> size;  ///< pixels, with the legend
  std::optional<int> samples;      ///< rays per pixel
  bool transparent = false;        ///< without a background
  double dots_per_inch = 0.0;      ///< of the printed picture; 0: not said
};

/// A figure, whatever its size. Commands change it, undo and redo replace it.
struct PreviewFigure {
  Camera camera;
  bool overview = true;  ///< all is shown, until the camera is moved
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = kUsualProbe;  ///< Å; without effect while the surface has no probe
  std::optional<Selection> show;      ///< atoms whose part of the surface is drawn; nothing: all
  std::optional<Selection> patches;   ///< of these atoms, outlined; nothing: none
  double least_patch = 10.0;          ///< Å²: smaller ones are not
  ColorScheme color;
  bool patch_kinds = false;  ///< coloured by kind of patch, whatever the scheme (figure 2 of Krone et al. 2010)
  FigureRequest figure;
  LookRequest look;
  LookPreset preset = LookPreset::publication;  ///< the word that was chosen last
  glm::vec3 background{1.0f};                   ///< sRGB
  bool legend = false;
  LegendStyle legend_style;
  LetterStyle letters;
  int samples = 4;  ///< rays per pixel of the full picture
  ExportOptions export_options;
  std::uint64_t edition = 0;  ///< a number of its own for all that was changed, but for the camera

  /// What the colours are by, kinds of patch too.
  ColorScheme shown_scheme() const;
  /// What its light may do to them.
  Hues hues() const {
    const bool looks_inside = uses_atoms(figure.cuts);
    if (!patch_kinds) return hues_of(color, looks_inside);
    ColorScheme kinds;
    kinds.opacities = color.opacities;
    return hues_of(kinds, looks_inside);
  }
  /// How far from the atoms' balls something may be and still change their surface, Å.
  double probe_reach() const { return growth_of(kind, probe_radius) + rolling_probe(kind, probe_radius); }
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
  double frames_per_second = 10.0;            ///< while playing
  glm::ivec2 size{1024, 768};                 ///< of the full picture with its legend, in pixels
  bool copies_apart = false;                  ///< no probe may touch two copies of the structure (Structure::instances)
  std::map<std::string, Camera> named_views;  ///< kept by the user
  std::vector<KeptScene> strip;               ///< scenes kept for a film, in its order
  std::uint64_t last_kept = 0;                ///< the number of the scene that was kept last
  double strip_place = 0.0;                   ///< of the strip, which was shown last
  std::uint64_t strip_shown = 0;              ///< how many pictures of a film that plays show the scene there
  double strip_rate = 25.0;                   ///< pictures per second of the strip while it plays
  bool plays_strip = false;                   ///< playing goes along the strip, not through the frames
  std::uint64_t revision = 1;                 ///< grows with every change of what is seen
  bool ended = false;                         ///< a command asked to end

  /// Returns the pictures per second of what plays.
  double rate() const { return plays_strip ? strip_rate : frames_per_second; }
  /// Of the full picture, its legend included.
  Look full_look() const { return look_of(look, size, background, hues(), patches.has_value()); }
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

/// A picture of a preview.
struct RenderedView {
  const PreviewFigure& figure;
  glm::ivec2 size;  ///< pixels, with the legend
  int samples = 1;
  bool transparent = false;                    ///< instead of the background
  std::optional<std::int32_t> model;           ///< that is shown, if the file has several
  std::optional<std::uint64_t> frame;          ///< of a trajectory
  std::optional<std::array<double, 2>> range;  ///< of numbers, where those of one model alone would have another
  double dots_per_inch = 0.0;                  ///< of the printed picture; 0: not said
};

/// begun: the scene that the preview began with, which says what it does not change: the molecule, its run.
Scene rendered_scene(const Scene& begun, const RenderedView& view);

/// Returns a request for a look with these numbers. asked: has what is no number of a look.
LookRequest look_request(LookRequest asked, Look look, bool outlines_patches);

/// What commands change, as a scene has it; no camera. color: with the numbers of its file.
PreviewFigure figure_of(const Scene& scene, const ColorScheme& color);

}  // namespace meniscus
