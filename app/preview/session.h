// SPDX-License-Identifier: BSD-3-Clause
// What a preview shows and how it changes: one set of JSON commands for the window, the page and recorded sessions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"
#include "app/preview/exposed_areas.h"
#include "app/preview/trajectory_positions.h"
#include "app/preview/edit_history.h"
#include "app/preview/legend_strip.h"
#include "app/preview/preview_view.h"
#include "app/preview/export_job.h"
#include "app/preview/rendered_scene.h"
#include "app/preview/view_export.h"
#include "core/camera/camera.h"
#include "core/camera/camera_path.h"
#include "core/render/annotation.h"
#include "core/render/look.h"
#include "core/scene/view_renderer.h"
#include "core/structure/atom_groups.h"
#include "core/structure/structure.h"

namespace meniscus {

class CommandReader;

/// A picture while something moves, or at rest.
enum class Quality {
  draft,  ///< half the size, one ray a pixel, no effects
  plain,  ///< the same in full size
  full    ///< as exported
};

/// A figure that a scene file says, of the molecule that is shown.
struct OpenedScene {
  PreviewFigure figure;
  ExportWishes wishes;
  int frame = 0;  ///< of a file of several models, from 0
};

/// What a session needs of the program around it; all of it may be missing.
struct SessionContext {
  /// Reads the molecule again as it is at a frame, with the atoms that are drawn beside its surface
  /// (FigureRequest::ask_for); so they are those that `meniscus render` would draw. Throws InputError.
  std::function<Structure(const FigureRequest& figure, std::size_t frame)> read_shown;
  std::optional<Scene> scene;     ///< that the preview began with; nothing: it writes no scenes
  MakePictureDevice make_device;  ///< of exported pictures
  /// What is written into exported pictures of the molecule, as it is at a frame.
  std::function<Annotations(const Structure& structure)> annotations;
  /// Reads a scene. Throws InputError, UsageError; RequestError where it is one of another molecule.
  std::function<OpenedScene(const std::filesystem::path& path)> open_scene;
};

/// A molecule, how it is seen, and the renderer that draws it. Used by one thread.
class PreviewSession {
 public:
  /// Each model of the structure, which has atoms, is a frame; with `trajectory` these are the frames of its one model.
  /// A structure with instances has one model, and the renderer draws its copies.
  /// `view` says how it looks at first; without `camera` everything is shown. Throws InputError for a bad camera or
  /// first frame, and as color_atoms does.
  PreviewSession(std::unique_ptr<ViewRenderer> renderer, Structure structure, PreviewView view,
                 const std::optional<Camera>& camera, std::filesystem::path export_folder,
                 std::optional<TrajectoryPositions> trajectory = {}, SessionContext context = {});

  /// Carries out {"command": WORD, ...} and answers {"ok": true, ...} or {"ok": false, "error": "one clear line"};
  /// after an error nothing has changed. The commands: app/preview/commands.md. Throws GpuError only: then all is lost.
  nlohmann::json apply(const nlohmann::json& command);

  /// Calls `sink` with every command from now on that was carried out and is no mere question (is_question).
  void record(std::function<void(const nlohmann::json&)> sink) { sink_ = std::move(sink); }

  /// Draws, unless this very picture is there already. stop: asked now and then; if true, the picture is given up:
  /// false, and the last one stays. Throws GpuError, CapacityError, OpenSurfaceError; but for the first of them the
  /// session can go on.
  bool render(Quality quality, const std::function<bool()>& stop = {});
  /// Is the last picture what render(quality) would draw?
  bool is_drawn(Quality quality) const;

  /// The last picture with its legend; see ViewRenderer::draw(). A new one may come with render and with apply (pick).
  std::vector<std::uint8_t> rgba() const;
  /// Of GL; 0: the picture is rgba() alone.
  std::uint32_t texture() const { return drawn_legend_ ? 0 : renderer_->texture(); }
  glm::ivec2 picture_size() const;

  /// While playing, a face sends {"command":"next_frame"} at this pace.
  bool playing() const { return view_.playing; }
  double frames_per_second() const { return view_.frames_per_second; }
  /// Grows with every change of what is seen.
  std::uint64_t revision() const { return revision_; }
  /// A command asked to end.
  bool wants_to_quit() const { return quit_; }

  /// Of cuts of the surface as it is seen now: a sentence for each that cuts nothing or leaves nothing.
  std::vector<std::string> idle_among(std::span<const Cut> cuts) const;

  const PreviewView& view() const { return view_; }
  const Structure& structure() const { return structure_; }
  std::size_t frame_count() const { return trajectory_ ? trajectory_->numbers.size() : frames_.size(); }

 private:
  /// A row of the table of commands.
  struct Command;
  static const std::vector<Command>& commands();

  nlohmann::json orbit(const CommandReader& command);
  nlohmann::json pan(const CommandReader& command);
  nlohmann::json zoom(const CommandReader& command);
  nlohmann::json roll(const CommandReader& command);
  nlohmann::json zoom_to(const CommandReader& command);
  nlohmann::json center(const CommandReader& command);
  nlohmann::json save_view(const CommandReader& command);
  nlohmann::json recall_view(const CommandReader& command);
  nlohmann::json forget_view(const CommandReader& command);
  nlohmann::json reset_view(const CommandReader& command);
  nlohmann::json set_camera(const CommandReader& command);
  nlohmann::json set_projection(const CommandReader& command);
  nlohmann::json set_surface(const CommandReader& command);
  nlohmann::json set_probe(const CommandReader& command);
  nlohmann::json set_color(const CommandReader& command);
  nlohmann::json set_patch_kinds(const CommandReader& command);
  nlohmann::json set_look(const CommandReader& command);
  nlohmann::json set_preset(const CommandReader& command);
  nlohmann::json show(const CommandReader& command);
  nlohmann::json hide(const CommandReader& command);
  nlohmann::json represent(const CommandReader& command);
  nlohmann::json put_object(const CommandReader& command);
  nlohmann::json hide_surface(const CommandReader& command);
  nlohmann::json set_radii(const CommandReader& command);
  nlohmann::json paint(const CommandReader& command);
  nlohmann::json set_opacity(const CommandReader& command);
  nlohmann::json set_film_opacity(const CommandReader& command);
  nlohmann::json set_cut(const CommandReader& command);
  nlohmann::json set_cap(const CommandReader& command);
  nlohmann::json remove(const CommandReader& command);
  nlohmann::json set_legend(const CommandReader& command);
  nlohmann::json undo(const CommandReader& command);
  nlohmann::json redo(const CommandReader& command);
  nlohmann::json end_step(const CommandReader& command);
  nlohmann::json render_command(const CommandReader& command);
  nlohmann::json set_frame(const CommandReader& command);
  nlohmann::json next_frame(const CommandReader& command);
  nlohmann::json set_key(const CommandReader& command);
  nlohmann::json follow_keys(const CommandReader& command);
  nlohmann::json play(const CommandReader& command);
  nlohmann::json pause(const CommandReader& command);
  nlohmann::json resize(const CommandReader& command);
  nlohmann::json set_samples(const CommandReader& command);
  nlohmann::json press(const CommandReader& command);
  nlohmann::json pick(const CommandReader& command);
  nlohmann::json export_view(const CommandReader& command);
  nlohmann::json export_state(const CommandReader& command);
  nlohmann::json cancel_export(const CommandReader& command);
  nlohmann::json save_scene(const CommandReader& command);
  nlohmann::json open_scene(const CommandReader& command);
  nlohmann::json stats(const CommandReader& command);
  nlohmann::json state(const CommandReader& command);
  nlohmann::json choices(const CommandReader& command);
  nlohmann::json quit(const CommandReader& command);

  nlohmann::json carry_out(const nlohmann::json& command);
  /// Rules of colour, representations, cuts and the like.
  void tell_figure(nlohmann::json& state) const;
  /// What of a figure is made of its molecule.
  struct Derived {
    std::optional<Coloring> coloring;         ///< of all atoms of the structure; nothing: as it is
    std::shared_ptr<const Structure> marked;  ///< the frame with the atoms beside its surface; nullptr: none are drawn
    std::shared_ptr<const BesideSurface> beside;
  };
  /// What of it a command has changed, from the least to the most.
  enum class Changed { view, cuts, colors, shapes };

  void look_from(const Camera& camera);
  void look_at_all();
  void become(PreviewFigure next, Changed changed);
  Derived derived(const PreviewFigure& figure, Changed changed, std::size_t frame) const;
  std::shared_ptr<const BesideSurface> beside_of(const PreviewFigure& figure, Changed changed,
                                                 const Structure* marked) const;
  void restore(const std::optional<PreviewFigure>& figure, const char* none);
  /// Of the atoms of the surface those that are shown, which may be told by what stands beside them; nullptr: nothing.
  std::vector<bool> part_shown(const Selection& show, const Structure* marked) const;
  /// How many that are. Throws RequestError if it is none.
  std::size_t count_shown(const PreviewFigure& figure, const Structure* marked) const;
  /// The scene of that picture; empty where there is none.
  std::string scene_of(const CommandReader& command) const;
  /// The command that makes the picture which a command wishes.
  Scene shown_scene(const CommandReader& command) const;
  void update_legend();
  std::uint64_t number_of(std::size_t frame) const { return trajectory_ ? trajectory_->numbers[frame] : frame; }
  std::vector<CameraKey> camera_keys() const;
  /// area_wanted: else only if it is known or cheap.
  std::optional<double> exposed_area(std::uint32_t atom, bool wait, bool area_wanted);
  void sample_trajectory();
  void show_frame(std::size_t frame);
  /// The balls of the frame that is shown, for the kind of surface that is.
  void place_balls();
  /// Throws InputError if a probe would touch two copies that are to be apart.
  void require_apart_in(const PreviewFigure& figure) const;
  /// Of the frame that is shown, into structure_.atoms.
  const std::vector<std::uint32_t>& shown_atoms() const { return frames_[trajectory_ ? 0 : view_.frame].atoms; }
  /// The same and behind them those that are drawn beside the surface.
  std::vector<Atom> atoms_in_view() const;
  /// Those of the surface's atoms, and around what is drawn beside them.
  std::vector<Ball> balls_in_view() const;
  /// The atoms of the frame alone.
  Structure frame_structure() const;
  Coloring frame_coloring() const;
  const std::vector<Ball>& reach() const { return reach_.empty() ? balls_ : reach_; }
  /// Of the part of the picture that the molecule has.
  glm::ivec2 molecule_size() const { return legend_ ? legend_->molecule_size() : view_.size; }
  double aspect() const { return static_cast<double>(molecule_size().x) / molecule_size().y; }
  Look look() const { return look_of(view_.look, view_.size, view_.background, view_.hues()); }
  RenderSettings settings(Quality quality) const;
  /// What the pixel shows, drawn anew if need be. Throws RequestError outside of the picture.
  std::optional<PickedPoint> point_at(const CommandReader& command);

  /// What of the session the last picture shows.
  struct Drawn {
    std::uint64_t revision = 0;
    Quality quality = Quality::draft;
  };

  Structure structure_;
  std::vector<AtomGroup> frames_;  ///< models
  std::optional<TrajectoryPositions> trajectory_;
  std::vector<Ball> sampled_;  ///< of frames all over the trajectory, for a view of all
  PreviewView view_;
  std::filesystem::path export_folder_;
  SessionContext context_;
  Camera first_camera_;  ///< what reset_view brings back
  bool first_overview_ = true;
  ColorScheme first_color_;  ///< with what files said
  EditHistory history_;
  std::map<std::string, Camera> named_views_;
  std::vector<Ball> balls_;                          ///< of the frame shown, grown by growth_of() its kind of surface
  std::vector<Ball> reach_;                          ///< what cameras see of the copies; without any: empty
  Coloring coloring_;                                ///< of all atoms of the structure
  std::shared_ptr<const Structure> marked_;          ///< see Derived
  std::shared_ptr<const BesideSurface> beside_;      ///< the surface; nullptr: nothing
  std::shared_ptr<const LegendStrip> legend_;        ///< of the view; nullptr: none
  std::string legend_fault_;                         ///< why there is none though it is wanted
  std::shared_ptr<const LegendStrip> drawn_legend_;  ///< of the last picture
  std::unique_ptr<ViewRenderer> renderer_;
  ExposedAreas areas_;
  std::uint64_t revision_ = 1;  ///< grows with every change
  Drawn drawn_;
  double frame_ms_ = 0.0;          ///< of the last picture
  std::vector<StageTime> stages_;  ///< of the last picture that was no draft: nobody waits for the stages of those
  std::function<void(const nlohmann::json&)> sink_;
  bool quit_ = false;
  std::unique_ptr<ExportJob> export_;  ///< the latest; nullptr: none yet
};

}  // namespace meniscus
