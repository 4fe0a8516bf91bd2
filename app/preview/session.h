// SPDX-License-Identifier: BSD-3-Clause
// What a preview shows and how it changes: one set of JSON commands for the window, the page and recorded sessions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"
#include "app/preview/exposed_areas.h"
#include "app/preview/trajectory_positions.h"
#include "core/structure/atom_groups.h"
#include "core/color/color_schemes.h"
#include "core/structure/structure.h"
#include "core/camera/camera.h"
#include "core/camera/camera_path.h"
#include "core/render/look.h"
#include "core/scene/view_renderer.h"

namespace meniscus {

class CommandReader;

/// What is seen, and how; all but `hidden` changes by commands.
struct PreviewView {
  Camera camera;
  double probe_radius = 1.4;  ///< Å
  ColorScheme color;
  std::vector<bool> hidden;  ///< per atom of the structure: its part of the surface is not drawn; empty: all is
  bool patch_kinds = false;  ///< coloured by kind of patch, whatever the scheme (figure 2 of Krone et al. 2010)
  Look look;
  std::size_t frame = 0;               ///< from 0
  std::map<std::size_t, Camera> keys;  ///< of the camera, by frame; all of one projection
  bool follows_keys = false;           ///< showing a frame moves the camera along its keys
  bool playing = false;
  double frames_per_second = 10.0;  ///< while playing
  glm::ivec2 size{1024, 768};       ///< of the full picture, in pixels
  int samples = 4;                  ///< rays per pixel of the full picture
  bool copies_apart = false;        ///< no probe may touch two copies of the structure (Structure::instances)
};

/// A picture while something moves, or at rest.
enum class Quality {
  draft,  ///< half the size, one ray a pixel, no effects
  plain,  ///< the same in full size
  full    ///< as exported
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
                 std::optional<TrajectoryPositions> trajectory = {});

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

  /// The last picture; see ViewRenderer::draw(). A new one may come with render and with apply (pick).
  std::vector<std::uint8_t> rgba() const { return renderer_->rgba(); }
  std::uint32_t texture() const { return renderer_->texture(); }  ///< of GL; 0: the picture is rgba() alone
  glm::ivec2 picture_size() const { return renderer_->size(); }

  /// While playing, a face sends {"command":"next_frame"} at this pace.
  bool playing() const { return view_.playing; }
  double frames_per_second() const { return view_.frames_per_second; }
  /// Grows with every change of what is seen.
  std::uint64_t revision() const { return revision_; }
  /// A command asked to end.
  bool wants_to_quit() const { return quit_; }

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
  nlohmann::json reset_view(const CommandReader& command);
  nlohmann::json set_camera(const CommandReader& command);
  nlohmann::json set_projection(const CommandReader& command);
  nlohmann::json set_probe(const CommandReader& command);
  nlohmann::json set_color(const CommandReader& command);
  nlohmann::json set_patch_kinds(const CommandReader& command);
  nlohmann::json set_look(const CommandReader& command);
  nlohmann::json set_frame(const CommandReader& command);
  nlohmann::json next_frame(const CommandReader& command);
  nlohmann::json set_key(const CommandReader& command);
  nlohmann::json follow_keys(const CommandReader& command);
  nlohmann::json play(const CommandReader& command);
  nlohmann::json pause(const CommandReader& command);
  nlohmann::json resize(const CommandReader& command);
  nlohmann::json set_samples(const CommandReader& command);
  nlohmann::json pick(const CommandReader& command);
  nlohmann::json export_view(const CommandReader& command);
  nlohmann::json stats(const CommandReader& command);
  nlohmann::json state(const CommandReader& command);
  nlohmann::json choices(const CommandReader& command);
  nlohmann::json quit(const CommandReader& command);

  nlohmann::json carry_out(const nlohmann::json& command);
  void look_from(const Camera& camera);
  void look_at_all();
  std::uint64_t number_of(std::size_t frame) const { return trajectory_ ? trajectory_->numbers[frame] : frame; }
  std::vector<CameraKey> camera_keys() const;
  std::optional<double> exposed_area(std::uint32_t atom, bool wait);
  void sample_trajectory();
  void show_frame(std::size_t frame);
  /// Of the frame that is shown, into structure_.atoms.
  const std::vector<std::uint32_t>& shown_atoms() const { return frames_[trajectory_ ? 0 : view_.frame].atoms; }
  Coloring frame_coloring() const;
  const std::vector<Ball>& reach() const { return reach_.empty() ? balls_ : reach_; }
  double aspect() const { return static_cast<double>(view_.size.x) / view_.size.y; }
  RenderSettings settings(Quality quality) const;

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
  std::vector<Ball> balls_;  ///< of the frame shown
  std::vector<Ball> reach_;  ///< what cameras see of the copies; without any: empty
  Coloring coloring_;        ///< of all atoms of the structure
  std::unique_ptr<ViewRenderer> renderer_;
  ExposedAreas areas_;
  std::uint64_t revision_ = 1;  ///< grows with every change
  Drawn drawn_;
  bool overview_ = true;           ///< all is shown, as long as nobody moved the camera
  double frame_ms_ = 0.0;          ///< of the last picture
  std::vector<StageTime> stages_;  ///< of the last picture that was no draft: nobody waits for the stages of those
  std::function<void(const nlohmann::json&)> sink_;
  bool quit_ = false;
};

}  // namespace meniscus
