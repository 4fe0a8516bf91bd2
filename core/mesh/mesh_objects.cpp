// SPDX-License-Identifier: BSD-3-Clause
// Makes meshes of the requested fineness, and estimates beforehand how many triangles they have.
#include "core/mesh/mesh_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/mesh/border_samples.h"
#include "core/mesh/even_mesh.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/tessellate.h"
#include "core/queries/surface_object.h"

namespace meniscus {

double tolerance_of(const MeshRequest& request, glm::ivec2 size, const Camera& camera, std::span<const Ball> balls) {
  if (request.tolerance_pixels == 0.0) return request.tolerance;
  // A pixel is 2 * half height / rows: of the plane at distance 1 (perspective), or in Å anywhere (orthographic).
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
  if (!any && !may_be_empty) throw RequestError("no part of the surface is shown, so there is no mesh to write");
  return meshes;
}

namespace {

/// The measured density of an even mesh by tolerance: vertices per Å² times tolerance times radius of curvature.
constexpr double kEvenVertices = 0.36;
/// The number of triangles per vertex of an even mesh.
constexpr double kTrianglesAVertex = 2.0;
/// The measured number of triangles per border segment, on both sides together, in a mesh that follows patches.
constexpr double kTrianglesASegment = 2.3;

double patch_aligned_triangles(const Surface& surface, double tolerance) {
  const EdgeRule rule(MeshOptions{tolerance, true});
  double triangles = 0.0;
  for (const Border& border : surface.borders)
    if (border.radius > 0.0)
      triangles += kTrianglesASegment * std::max(1.0, border.sweep * border.radius / rule.chord(border.radius));
  for (const Face& face : surface.faces) {
    const double edge = rule.edge(tube_radius(surface, face));
    triangles += 4.0 / std::numbers::sqrt3 * face.area / (edge * edge);
  }
  return triangles;
}

double even_triangles(const Surface& surface, const MeshFineness& fineness) {
  double vertices = fineness.density * surface.area;
  if (fineness.density == 0.0)
    for (const Face& face : surface.faces)
      vertices += kEvenVertices * face.area / (fineness.tolerance * std::max(tube_radius(surface, face), 0.1));
  return kTrianglesAVertex * vertices;
}

}  // namespace

MeshFineness fineness_of(const MeshRequest& request, bool even, double density, glm::ivec2 size, const Camera& camera,
                         std::span<const Ball> balls) {
  MeshFineness fineness{tolerance_of(request, size, camera, balls), {}, density, even};
  if (request.tolerance_pixels == 0.0 || camera.projection == Projection::orthographic) return fineness;
  const double wanted = request.tolerance_pixels * 2.0 * half_extent(camera, double(size.x) / size.y).y / size.y;
  fineness.tolerance_at = [wanted, position = camera.position, forward = view_basis(camera).forward,
                           smallest = fineness.tolerance](const glm::dvec3& x) {
    return std::clamp(wanted * glm::dot(x - position, forward), smallest, kLargestTolerance);
  };
  return fineness;
}

double estimated_triangles(const Surface& surface, const MeshFineness& fineness) {
  return fineness.even || fineness.density > 0.0 ? even_triangles(surface, fineness)
                                                 : patch_aligned_triangles(surface, fineness.tolerance);
}

FineMesh fine_mesh(const Surface& surface, const MeshFineness& fineness) {
  if (fineness.even || fineness.density > 0.0)
    return even_mesh(surface, {fineness.density, fineness.tolerance, fineness.tolerance_at});
  FineMesh made{tessellate(surface, {fineness.tolerance, true}), {}, {}};
  made.vertex_face = vertex_faces(made.mesh);
  made.vertex_atom = vertex_atoms(made.mesh);
  return made;
}

}  // namespace meniscus
