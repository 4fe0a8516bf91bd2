// SPDX-License-Identifier: BSD-3-Clause
// Fills in what kernels are told.
#include "core/render/picture_block.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/image/color_space.h"

namespace meniscus {

namespace {

/// What studio_light() is told of the lamps.
struct Light {
  glm::vec3 key_color;
  float key_share;
  glm::vec3 fill_color;
  float fill_share;
  glm::vec3 sky, ground;
};

constexpr Light kStudio{.key_color = {1.0f, 0.97f, 0.92f},
                        .key_share = 0.78f,
                        .fill_color = {0.75f, 0.85f, 1.0f},
                        .fill_share = 0.20f,
                        .sky = {0.24f, 0.26f, 0.29f},
                        .ground = {0.10f, 0.09f, 0.09f}};

glm::vec3 fill_direction() { return glm::normalize(glm::vec3(0.85f, -0.05f, 0.45f)); }

/// Of white lamps, which together make 1 on a surface that faces the key light.
Light white_light(const glm::vec3& key_direction) {
  constexpr float kKey = 0.62f, kFill = 0.14f, kSky = 0.26f, kGround = 0.16f;
  const float sky = 0.5f + 0.5f * key_direction.y, facing = std::max(key_direction.z, 0.0f);
  const float fill = std::max((glm::dot(key_direction, fill_direction()) + 0.3f) / 1.3f, 0.0f);
  const float there = kKey + kFill * fill + (kGround + (kSky - kGround) * sky) * (0.35f + 0.65f * facing);
  const glm::vec3 white(1.0f);
  return {white, kKey / there, white, kFill / there, white * (kSky / there), white * (kGround / there)};
}

Light light_of(const Look& look) {
  return look.lamps == Lamps::studio ? kStudio : white_light(glm::normalize(look.light_direction));
}

}  // namespace

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
  const Light light = light_of(look);
  own.key_color = light.key_color;
  own.key_share = light.key_share;
  own.fill_direction = fill_direction();
  own.fill_color = light.fill_color;
  own.fill_share = light.fill_share;
  own.sky = light.sky;
  own.ground = light.ground;
  own.ambient = look.material.ambient;
  own.roughness = look.material.roughness;
  own.specular = look.ambient_occlusion > 0.0f ? 0.0f : look.material.specular;
  own.shininess = look.material.shininess;
  own.probe_radius = static_cast<float>(scene.probe_radius);
  own.slack = scene.slack;
  own.color_by_kind = color_by_kind;
  own.atom_count = atom_count;
  return own;
}

PictureFrame shade_map_frame(const PictureFrame& frame) {
  PictureFrame map = frame;
  const double edge = shade_texel_edge(frame.size);
  // No texel's middle lies outside of the picture.
  map.size = glm::max(glm::ivec2(glm::dvec2(frame.size) / edge), glm::ivec2(1));
  map.pixel_size *= edge;
  return map;
}

bool holds_shade_map(const PictureBlock& block, glm::ivec2 picture_size) {
  return block.size == picture_size && shade_texel_edge(picture_size) == 1.0f;
}

kernel::OcclusionParameters occlusion_parameters(const Look& look, glm::ivec2 picture_size, int sample) {
  PictureFrame frame;
  frame.size = picture_size;
  const glm::ivec2 map_size = shade_map_frame(frame).size;
  return {.map_middle = 0.5f * glm::vec2(map_size) - 0.5f,
          .map_size = map_size,
          .texel_edge = shade_texel_edge(picture_size),
          .near_reach = static_cast<float>(near_shade_reach(picture_size)),
          .radius = look.ambient_occlusion_radius,
          .longest_reach = glm::length(glm::vec2(picture_size)),
          .sample_index = static_cast<std::uint32_t>(sample)};
}

kernel::FinishParameters finish_parameters(const Look& look, const ScenePlacement& scene, glm::ivec2 picture_size,
                                           int sample, bool has_parts) {
  constexpr float kLeastPixels = 2.0f;  // of a step: what slopes and rounding make of none
  const float step_pixels = look.line_step * static_cast<float>(std::min(picture_size.x, picture_size.y));
  return {.key_direction = glm::normalize(look.light_direction),
          .key_strength = look.light_strength,
          .air = linear_from_srgb(look.background),
          .keeps_alpha = look.depth_cue_keeps_alpha,
          .specular = look.material.specular,
          .shininess = look.material.shininess,
          .ambient_occlusion = look.ambient_occlusion,
          .outer_lines = look.outer_lines.value_or(look.silhouettes),
          .inner_lines = look.inner_lines.value_or(look.silhouettes),
          .part_lines = look.part_lines.value_or(look.silhouettes),
          .widest_line = look.widest_line(),
          .step_pixels = std::max(step_pixels, kLeastPixels),
          .fade_pixels = 2.0f * step_pixels,
          .depth_cue = look.depth_cue,
          .first_depth = scene.first_depth,
          .last_depth = scene.last_depth,
          .sample_index = static_cast<std::uint32_t>(sample),
          .has_parts = has_parts};
}

}  // namespace meniscus
