// SPDX-License-Identifier: BSD-3-Clause
// As vertices have one colour, each goes into one mesh.
#include "exporters/path_tracers/split_colors.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

#include "core/image/color_space.h"

namespace meniscus::path_tracers {

namespace {

using Bytes = std::tuple<int, int, int>;

Bytes bytes_of(const glm::vec3& linear) {
  const glm::vec3 color = 255.0f * srgb_from_linear(linear);
  return {static_cast<int>(std::lround(color.x)), static_cast<int>(std::lround(color.y)),
          static_cast<int>(std::lround(color.z))};
}

glm::vec3 color_of(const Bytes& bytes) {
  const auto [red, green, blue] = bytes;
  return linear_from_srgb(glm::vec3(red, green, blue) / 255.0f);
}

}  // namespace

std::vector<SceneMesh> split_colors(const SceneMesh& mesh) {
  std::vector<SceneMesh> parts;
  std::map<Bytes, std::uint32_t> part_of_color;
  std::vector<std::uint32_t> part, place;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Bytes bytes = bytes_of(mesh.colors[v]);
    const auto next = static_cast<std::uint32_t>(parts.size());
    const auto [found, is_new] = part_of_color.try_emplace(bytes, next);
    if (is_new) parts.emplace_back().opacity = mesh.opacity;
    SceneMesh& to = parts[found->second];
    part.push_back(found->second);
    place.push_back(static_cast<std::uint32_t>(to.positions.size()));
    to.positions.push_back(mesh.positions[v]);
    to.normals.push_back(mesh.normals[v]);
    to.colors.push_back(color_of(bytes));
  }
  for (const auto& [a, b, c] : mesh.triangles) parts[part[a]].triangles.push_back({place[a], place[b], place[c]});
  return parts;
}

}  // namespace meniscus::path_tracers
