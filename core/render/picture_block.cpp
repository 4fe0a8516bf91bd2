// SPDX-License-Identifier: BSD-3-Clause
// Fills in what kernels are told.
#include "core/render/picture_block.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace meniscus {

glm::vec2 sample_offset(int index) {
  const double x = 0.5 + index * 0.7548776662466927, y = 0.5 + index * 0.5698402909980532;
  return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

kernel::BlockView block_view(const PictureFrame& frame, const PictureBlock& block, const glm::vec2& sample_offset) {
  return {.right = glm::vec3(frame.basis.right),
          .eye_distance = static_cast<float>(frame.eye_distance),
          .up = glm::vec3(frame.basis.up),
          .pixel_size = static_cast<float>(frame.pixel_size),
          .forward = glm::vec3(frame.basis.forward),
          .orthographic = frame.camera.projection == Projection::orthographic,
          .first_offset = glm::vec2(glm::dvec2(block.origin) + 0.5 - 0.5 * glm::dvec2(frame.size)),
          .sample_offset = sample_offset,
          .size = block.size};
}

kernel::TileListParameters tile_list_parameters(const PictureFrame& frame, const PictureBlock& block,
                                                std::uint32_t primitive_count) {
  return {.right = glm::vec3(frame.basis.right),
          .eye_distance = static_cast<float>(frame.eye_distance),
          .up = glm::vec3(frame.basis.up),
          .pixels_per_angstrom = static_cast<float>(1.0 / frame.pixel_size),
          .forward = glm::vec3(frame.basis.forward),
          .orthographic = frame.camera.projection == Projection::orthographic,
          .block_center = glm::vec2(0.5 * glm::dvec2(frame.size) - glm::dvec2(block.origin)),
          .tiles = tile_counts(block),
          .first_tile = block.origin / kTileEdge,
          .picture_tile_columns = (frame.size.x + kTileEdge - 1) / kTileEdge,
          .bounded = false,
          .primitive_count = primitive_count,
          .entry_capacity = 0};  // of no lists yet
}

kernel::RayCastParameters cast_parameters(const ScenePlacement& scene, const Look& look, std::uint32_t atom_count,
                                          bool color_by_kind) {
  kernel::RayCastParameters own{};
  own.key_direction = glm::normalize(look.light_direction);
  own.key_strength = look.light_strength;
  own.probe_radius = static_cast<float>(scene.probe_radius);
  own.slack = scene.slack;
  own.color_by_kind = color_by_kind;
  own.atom_count = atom_count;
  return own;
}

kernel::OcclusionParameters occlusion_parameters(const Look& look, int sample) {
  return {.radius = look.ambient_occlusion_radius,
          .longest_reach = static_cast<float>(kLongestShade),
          .sample_index = static_cast<std::uint32_t>(sample)};
}

kernel::FinishParameters finish_parameters(const Look& look, const ScenePlacement& scene, int sample, bool has_parts) {
  return {.ambient_occlusion = look.ambient_occlusion,
          .silhouettes = look.silhouettes,
          .depth_cue = look.depth_cue,
          .first_depth = scene.first_depth,
          .last_depth = scene.last_depth,
          .sample_index = static_cast<std::uint32_t>(sample),
          .has_parts = has_parts};
}

}  // namespace meniscus
