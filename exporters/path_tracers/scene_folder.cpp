// SPDX-License-Identifier: BSD-3-Clause
// Meshes first, and last the file that users open.
#include "exporters/path_tracers/scene_folder.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "exporters/path_tracers/mitsuba_scene.h"
#include "exporters/path_tracers/optics.h"
#include "exporters/path_tracers/pbrt_scene.h"
#include "exporters/path_tracers/ply_mesh.h"
#include "exporters/path_tracers/split_colors.h"

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

}  // namespace meniscus::path_tracers
