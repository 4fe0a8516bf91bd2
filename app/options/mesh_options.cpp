// SPDX-License-Identifier: BSD-3-Clause
// Declares the mesh options and turns pixels into Å.
#include "app/options/mesh_options.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "exporters/mesh/tessellate.h"

namespace meniscus {
namespace {

/// Below this a mesh of a protein no longer fits into memory, and float coordinates could not hold it.
constexpr double kSmallestTolerance = 1e-5;  // Å
constexpr double kLargestTolerance = 1.0;    // Å

}  // namespace

void add_mesh_options(CLI::App& command, MeshCommandOptions& options) {
  CLI::Option* const angstrom =
      command.add_option("--tolerance", options.tolerance, "Farthest the mesh may be from the surface, in Å [0.01]");
  angstrom->type_name("Å")->check(CLI::Range(kSmallestTolerance, kLargestTolerance));
  command.add_option("--tolerance-pixels", options.tolerance_pixels, "The same in pixels of the picture, e.g. 0.25")
      ->type_name("PIXELS")
      ->check(CLI::Range(1e-3, 100.0))
      ->excludes(angstrom);
}

double tolerance_of(const MeshCommandOptions& options, const PictureOptions& picture, const Camera& camera,
                    std::span<const Ball> balls) {
  if (options.tolerance_pixels == 0.0) return options.tolerance;
  // A pixel spans 2 * half height / rows of the plane at distance 1 (perspective), or in Å anywhere (orthographic).
  double pixel = 2.0 * half_extent(camera, double(picture.width) / picture.height).y / picture.height;
  if (camera.projection == Projection::perspective) {
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec3 forward = view_basis(camera).forward;
    for (const Ball& ball : balls) {
      nearest = std::min(nearest, glm::dot(ball.center - camera.position, forward) - ball.radius);
    }
    pixel *= std::max(nearest, 0.1);
  }
  return std::clamp(options.tolerance_pixels * pixel, kSmallestTolerance, kLargestTolerance);
}

std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance) {
  std::vector<TriangleMesh> meshes;
  bool any = false;
  for (const SurfaceObject& object : objects) {
    meshes.push_back(shown_part(tessellate(object.surface, {tolerance, true}), object.coloring));
    any = any || !meshes.back().triangles.empty();
  }
  if (!any) throw RequestError("nothing of the surface is shown, so there is no mesh to write");
  return meshes;
}

std::vector<TriangleMesh> meshes_of(const MoleculeOptions& options, std::span<const SurfaceObject> objects,
                                    double tolerance) {
  std::vector<TriangleMesh> meshes = mesh_objects(objects, tolerance);
  std::size_t triangles = 0;
  for (const TriangleMesh& mesh : meshes) triangles += mesh.triangles.size();
  say(options, fmt::format("{} triangles within {:.4g} Å of the surface", with_thousands(triangles), tolerance));
  return meshes;
}

}  // namespace meniscus
