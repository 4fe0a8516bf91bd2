// SPDX-License-Identifier: BSD-3-Clause
// As vertices have one colour, each goes into one mesh.
#include "exporters/path_tracers/split_colors.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

namespace meniscus::path_tracers {

std::vector<SceneMesh> split_colors(const SceneMesh& mesh) {
  std::vector<SceneMesh> parts;
  std::map<std::tuple<float, float, float>, std::uint32_t> part_of_color;
  std::vector<std::uint32_t> part, place;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3& color = mesh.colors[v];
    const auto next = static_cast<std::uint32_t>(parts.size());
    const auto [found, is_new] = part_of_color.try_emplace({color.x, color.y, color.z}, next);
    if (is_new) parts.emplace_back().opacity = mesh.opacity;
    SceneMesh& to = parts[found->second];
    part.push_back(found->second);
    place.push_back(static_cast<std::uint32_t>(to.positions.size()));
    to.positions.push_back(mesh.positions[v]);
    to.normals.push_back(mesh.normals[v]);
    to.colors.push_back(color);
  }
  for (const auto& [a, b, c] : mesh.triangles) parts[part[a]].triangles.push_back({place[a], place[b], place[c]});
  return parts;
}

}  // namespace meniscus::path_tracers
