// SPDX-License-Identifier: BSD-3-Clause
// Frames, colours and pictures of a session.
#include "app/preview/session.h"

#include <chrono>
#include <utility>

#include <glm/common.hpp>

#include "app/preview/camera_motion.h"
#include "app/preview/look_json.h"
#include "core/molecule/named_colors.h"

namespace meniscus {

std::string json_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

PreviewSession::PreviewSession(Structure structure, PreviewView view, const std::optional<Camera>& camera,
                               std::filesystem::path export_folder)
    : structure_(std::move(structure)),
      frames_(group_atoms(structure_, Grouping::model)),
      view_(std::move(view)),
      export_folder_(std::move(export_folder)),
      coloring_(color_atoms(structure_, view_.color)) {
  show_frame(0);
  look_from(camera ? *camera : overview(balls_, aspect(), view_.camera.projection));
}

void PreviewSession::look_from(const Camera& camera) {
  validate_camera(camera, "the view");
  view_.camera = camera;
}

void PreviewSession::show_frame(std::size_t frame) {
  view_.frame = frame;
  balls_.clear();
  for (const std::uint32_t a : frames_[frame].atoms)
    balls_.push_back({structure_.atoms[a].position, structure_.atoms[a].radius});
  renderer_.set_atoms(balls_);
  renderer_.set_coloring(frame_coloring());
}

Coloring PreviewSession::frame_coloring() const {
  Coloring coloring;
  coloring.kind = view_.patch_kinds ? kPatchKindColors : coloring_.kind;
  for (const std::uint32_t a : frames_[view_.frame].atoms) coloring.atom.push_back(coloring_.atom[a]);
  return coloring;
}

bool PreviewSession::is_drawn(Quality quality) const {
  return drawn_.revision == revision_ && drawn_.quality == quality;
}

FrameRequest PreviewSession::request(Quality quality) const {
  FrameRequest request;
  request.camera = view_.camera;
  request.size = view_.size;
  request.samples = view_.samples;
  request.probe_radius = view_.probe_radius;
  request.look = view_.look;
  if (quality == Quality::draft) {
    request.size = glm::max(view_.size / 2, glm::ivec2(1));
    request.samples = 1;
    request.look = draft_look(view_.look);
  }
  return request;
}

void PreviewSession::render(Quality quality) {
  if (!is_drawn(quality)) draw(request(quality), {revision_, quality, quality == Quality::full});
}

void PreviewSession::draw(const FrameRequest& request, const Drawn& what) {
  drawn_ = {};
  const auto begin = std::chrono::steady_clock::now();
  renderer_.render(request);
  frame_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  drawn_ = what;
}

}  // namespace meniscus
