// SPDX-License-Identifier: BSD-3-Clause
// Writes the files of a scene: its text, its meshes as binary PLY, split by colour for formats without colours of
// vertices.
#include "exporters/path_tracers/scene_folder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "exporters/mesh_files/writers.h"
#include "exporters/path_tracers/mitsuba_scene.h"
#include "exporters/path_tracers/lights.h"
#include "exporters/path_tracers/pbrt_scene.h"

namespace meniscus::path_tracers {
namespace {

std::vector<SceneMesh> split(const std::vector<SceneMesh>& meshes) {
  std::vector<SceneMesh> parts;
  for (const SceneMesh& mesh : meshes)
    for (SceneMesh& part : split_colors(mesh)) parts.push_back(std::move(part));
  return parts;
}

}  // namespace

SceneReport write_scene(const Scene& given, const SceneTarget& target) {
  Scene scene = given;
  std::erase_if(scene.items, [](const SceneItem& item) { return item.empty(); });
  if (scene.items.empty()) throw RequestError("nothing of the surface is shown, so there is no scene to write");
  OutputFolder output(target.folder, target.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(target.folder / (target.name + ending));
    return output.file(target.name + ending);
  };
  const bool has_colors = target.renderer == Renderer::mitsuba;  // at vertices
  std::size_t meshes = 0;
  for (SceneItem& item : scene.items) {
    if (!has_colors) item.meshes = split(item.meshes);
    for (SceneMesh& mesh : item.meshes) {
      for (glm::vec3& color : mesh.colors) color = written_color(scene.material, item.is_surface, color);
      write_mesh(begin_file(fmt::format("_{}.ply", ++meshes)), mesh, has_colors);
      report.triangles += mesh.triangles.size();
    }
    report.spheres += item.spheres.size();
    report.cylinders += item.cylinders.size();
  }
  if (target.renderer == Renderer::mitsuba)
    begin_file(".xml").write(mitsuba_text(scene, target.name));
  else
    begin_file(".pbrt").write(pbrt_text(scene, target.name));
  output.commit();
  return report;
}

// Turk 1994).

void write_mesh(OutputFile& file, const SceneMesh& mesh, bool with_colors) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  if (with_colors)
    for (const char* name : {"r", "g", "b"}) header += fmt::format("property float {}\n", name);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  BinaryRows rows;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    rows.put(mesh.positions[v]);
    rows.put(mesh.normals[v]);
    if (with_colors) rows.put(mesh.colors[v]);
  }
  for (const auto& triangle : mesh.triangles) {
    rows.put(std::uint8_t{3});
    rows.put(triangle);
  }
  file.write(header);
  file.write(rows.bytes());
}

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
