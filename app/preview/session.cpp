// SPDX-License-Identifier: BSD-3-Clause
// Frames, colours and pictures of a session.
#include "app/preview/session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <glm/common.hpp>

#include "app/preview/camera_motion.h"
#include "app/preview/look_json.h"
#include "core/base/error.h"
#include "core/color/color_atoms.h"
#include "core/color/named_colors.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/molecule.h"
#include "core/scene/surface_objects.h"

namespace meniscus {

PreviewSession::PreviewSession(std::unique_ptr<ViewRenderer> renderer, Structure structure, PreviewView view,
                               const std::optional<Camera>& camera, std::filesystem::path export_folder,
                               std::optional<TrajectoryPositions> trajectory)
    : structure_(std::move(structure)),
      frames_(group_atoms(structure_, Grouping::model)),
      trajectory_(std::move(trajectory)),
      view_(std::move(view)),
      export_folder_(std::move(export_folder)),
      coloring_(color_atoms(structure_, view_.color)),
      renderer_(std::move(renderer)) {
  require_colors_shared(structure_, view_.color);
  if (view_.copies_apart) require_apart(structure_, view_.probe_radius);
  if (trajectory_) sample_trajectory();
  show_frame(0);
  camera ? look_from(*camera) : look_at_all();
}

void PreviewSession::look_from(const Camera& camera) {
  validate_camera(camera, "the view");
  view_.camera = camera;
  overview_ = false;
}

void PreviewSession::look_at_all() {
  look_from(overview(trajectory_ ? sampled_ : reach(), aspect(), view_.camera.projection));
  overview_ = true;
}

void PreviewSession::sample_trajectory() {
  constexpr std::size_t kSamples = 16;  // few enough to begin at once, enough to see where the molecule goes
  const std::size_t count = std::min(kSamples, trajectory_->numbers.size());
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t frame = count == 1 ? 0 : n * (trajectory_->numbers.size() - 1) / (count - 1);
    try {
      const std::vector<glm::dvec3> positions = trajectory_->positions(frame);
      for (const std::uint32_t a : shown_atoms()) sampled_.push_back({positions[a], structure_.atoms[a].radius});
    } catch (const InputError&) {
      if (n == 0) throw;  // a later one is told when it is shown
    }
  }
}

void PreviewSession::show_frame(std::size_t frame) {
  if (trajectory_) {  // read first: what cannot be read changes nothing
    const std::vector<glm::dvec3> positions = trajectory_->positions(frame);
    for (std::size_t n = 0; n < positions.size(); ++n) structure_.atoms[n].position = positions[n];
  }
  view_.frame = frame;
  if (view_.follows_keys && !view_.keys.empty())
    look_from(CameraPath(camera_keys()).at(static_cast<double>(number_of(frame))));
  balls_.clear();
  for (const std::uint32_t a : shown_atoms())
    balls_.push_back({structure_.atoms[a].position, structure_.atoms[a].radius});
  reach_.clear();
  if (!structure_.instances.empty()) reach_ = reaching_balls(balls_, structure_.instances);
  renderer_->set_atoms(balls_);
  renderer_->set_coloring(frame_coloring());
}

std::vector<CameraKey> PreviewSession::camera_keys() const {
  std::vector<CameraKey> keys;
  for (const auto& [frame, camera] : view_.keys) keys.push_back({static_cast<double>(number_of(frame)), camera});
  return keys;
}

Coloring PreviewSession::frame_coloring() const {
  Coloring coloring;
  coloring.kind = view_.patch_kinds ? kPatchKindColors : coloring_.kind;
  for (const std::uint32_t a : shown_atoms()) {
    coloring.atom.push_back(coloring_.atom[a]);
    if (!coloring_.part.empty()) coloring.part.push_back(coloring_.part[a]);
    if (!coloring_.opacity.empty()) coloring.opacity.push_back(coloring_.opacity[a]);
    if (!view_.hidden.empty()) coloring.hidden.push_back(view_.hidden[a]);
  }
  return coloring;
}

bool PreviewSession::is_drawn(Quality quality) const {
  return drawn_.revision == revision_ && drawn_.quality == quality;
}

RenderSettings PreviewSession::settings(Quality quality) const {
  RenderSettings settings;
  settings.size = quality == Quality::draft ? glm::max(view_.size / 2, glm::ivec2(1)) : view_.size;
  settings.samples = quality == Quality::full ? view_.samples : 1;
  settings.look = quality == Quality::full ? view_.look : without_effects(view_.look);
  settings.timing = quality == Quality::draft ? StageTiming::rough : StageTiming::exact;
  return settings;
}

bool PreviewSession::render(Quality quality, const std::function<bool()>& stop) {
  if (is_drawn(quality)) return true;
  drawn_ = {};
  const auto begin = std::chrono::steady_clock::now();
  if (!renderer_->draw(view_.probe_radius, view_.camera, settings(quality), stop)) return false;
  if (quality != Quality::draft || stages_.empty()) stages_ = renderer_->times();
  frame_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  drawn_ = {revision_, quality};
  return true;
}

}  // namespace meniscus
