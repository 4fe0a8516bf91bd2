// SPDX-License-Identifier: BSD-3-Clause
// Steps along the normals of some vertices as far as the vertex remains the nearest point of the surface. The winding
// number of the triangles confirms the point; if it is not inside them, a point below one of the triangles is taken.
#include "exporters/mesh_files/inner_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/queries/distance.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

constexpr std::size_t kPlaces = 48;  // vertices tried per component; the longest step is taken
constexpr double kLongest = 2.8, kShorter = 0.7, kShortest = 1e-4, kEnough = 1.0;  // Å, except the ratio kShorter
constexpr double kShareOfHeight = 0.1, kSmallestShare = 1e-5;  // depths below a triangle, as shares of its height
constexpr double kSame = 1e-9;                                 // rounding error of distances, Å

/// Returns the longest tried step (Å, at most kLongest) from a point of the surface along its normal whose end is as
/// far from the surface as the step is long. A ball with this radius around the end is empty and touches the surface at
/// the point. side: 1 to step along the normal, -1 against it. Returns 0 if no step works.
double clear_step(const SurfaceDistance& distance, const glm::dvec3& from, const glm::dvec3& normal, double side) {
  for (double step = kLongest; step > kShortest; step *= kShorter)
    if (std::abs(distance(from + side * step * normal).distance - side * step) < kSame) return step;
  return 0.0;
}

/// Returns the winding number of closed triangles around a point. It is the sum of their solid angles (A. van Oosterom
/// and J. Strackee, IEEE Trans. Biomed. Eng. 30, 125 (1983), equation 8) divided by 4 pi, rounded to an integer.
long winding_number(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const glm::dvec3& point) {
  double angle = 0.0;
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i] - point, b = mesh.positions[j] - point, c = mesh.positions[k] - point;
    const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  }
  return std::lround(angle / (4.0 * std::numbers::pi));
}

/// Returns a point right below a triangle that has this winding number, or nothing. The mesh alone determines it,
/// because coarse triangles may exclude points inside the exact surface.
std::optional<glm::dvec3> point_below(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                                      long winding) {
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    for (double share = kShareOfHeight; share > kSmallestShare; share *= 0.1) {
      // Triangles face the solvent, which is inside a cavity and outside a solid.
      const glm::dvec3 point = (a + b + c) / 3.0 - static_cast<double>(winding) * share / longest * cross;
      if (winding_number(mesh, triangles, point) == winding) return point;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<glm::dvec3> inner_points(const Surface& surface, const TriangleMesh& mesh) {
  const SurfaceDistance distance(surface);
  std::vector<std::vector<std::uint32_t>> triangles(surface.components.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[mesh.component[t]].push_back(t);
  std::vector<glm::dvec3> points;
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    const double side = surface.components[c].kind == ComponentKind::cavity ? 1.0 : -1.0;
    const std::size_t stride = std::max<std::size_t>(1, triangles[c].size() / kPlaces);
    double longest = 0.0;
    glm::dvec3 point(0.0);
    for (std::size_t n = 0; n < triangles[c].size() && longest < kEnough; n += stride) {
      const std::uint32_t v = mesh.triangles[triangles[c][n]][0];
      const double step = clear_step(distance, mesh.positions[v], mesh.normals[v], side);
      if (step <= longest) continue;
      longest = step;
      point = mesh.positions[v] + side * step * mesh.normals[v];
    }
    const long winding = side > 0.0 ? -1 : 1;
    if (longest == 0.0 || winding_number(mesh, triangles[c], point) != winding) {
      const auto below = point_below(mesh, triangles[c], winding);
      if (!below)
        throw OpenSurfaceError(
            fmt::format("no point was found inside component {} of the mesh; ask for a finer one", c));
      point = *below;
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace meniscus
