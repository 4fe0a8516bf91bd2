// SPDX-License-Identifier: BSD-3-Clause
// Meshes the surfaces of several objects, and turns a tolerance in pixels into Å.
#include "core/mesh/mesh_objects.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/mesh/tessellate.h"

namespace meniscus {

double tolerance_of(const MeshRequest& request, glm::ivec2 size, const Camera& camera, std::span<const Ball> balls) {
  if (request.tolerance_pixels == 0.0) return request.tolerance;
  // A pixel spans 2 * half height / rows of the plane at distance 1 (perspective), or in Å anywhere (orthographic).
  double pixel = 2.0 * half_extent(camera, double(size.x) / size.y).y / size.y;
  if (camera.projection == Projection::perspective) {
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec3 forward = view_basis(camera).forward;
    for (const Ball& ball : balls) {
      nearest = std::min(nearest, glm::dot(ball.center - camera.position, forward) - ball.radius);
    }
    pixel *= std::max(nearest, 0.1);
  }
  return std::clamp(request.tolerance_pixels * pixel, kSmallestTolerance, kLargestTolerance);
}

std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance, bool may_be_empty) {
  std::vector<TriangleMesh> meshes;
  bool any = false;
  for (const SurfaceObject& object : objects) {
    meshes.push_back(shown_part(tessellate(object.surface, {tolerance, true}), object.coloring));
    any = any || !meshes.back().triangles.empty();
  }
  if (!any && !may_be_empty) throw RequestError("nothing of the surface is shown, so there is no mesh to write");
  return meshes;
}

std::size_t triangle_count(std::span<const TriangleMesh> meshes) {
  return std::accumulate(meshes.begin(), meshes.end(), std::size_t{0},
                         [](std::size_t sum, const TriangleMesh& mesh) { return sum + mesh.triangles.size(); });
}

}  // namespace meniscus
