// SPDX-License-Identifier: BSD-3-Clause
// Measures how far an even mesh is from its surface at places in its triangles, and the surface from it at points.
#include "core/mesh/mesh_nearness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/mesh/compare_mesh.h"
#include "core/mesh/creases.h"
#include "core/mesh/even_sizes.h"
#include "core/mesh/tessellate.h"
#include "core/surface/walks.h"

namespace meniscus {

using Tuning = RemeshTuning;

std::optional<SurfacePoint> below(const MeshOnSurface& mesh, const glm::dvec3& x,
                                  const std::array<std::uint32_t, 3>& corners) {
  for (const bool smooth : {true, false})  // a vertex of a crease is on both sides of it
    for (const std::uint32_t v : corners) {
      if (v >= mesh.positions().size() || mesh.vertex(v).on_crease() == smooth) continue;
      if (const auto at = mesh.walk().below(x, mesh.vertex(v).face)) return at;
    }
  return std::nullopt;
}

void MeshNearness::ask_for(const BaseMesh& base) {
  const TriangleMesh& mesh = base.mesh;
  to_reach_.clear();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) to_reach_.push_back({mesh.positions[v], base.vertex_face[v]});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    if (const auto at = walk_.below(middle, mesh.face[t])) to_reach_.push_back(*at);
  }
  for (const Border& border : surface_.borders) {
    if (crease_angle(surface_, border) == 0.0) continue;
    const double step = Tuning::crease_step * sizes_.tolerance_at(arc_point(border, 0.5 * border.sweep));
    const auto count = static_cast<std::uint32_t>(std::ceil(border.radius * border.sweep / step));
    for (std::uint32_t k = 1; k < count; ++k)
      to_reach_.push_back({arc_point(border, border.sweep * k / count), border.face[0]});
  }
}

const SurfaceDistance& MeshNearness::distance() const {
  std::call_once(distance_made_, [&] { distance_.emplace(surface_); });
  return *distance_;
}

std::optional<glm::dvec3> MeshNearness::far_place(const MeshOnSurface& mesh, const PlacedTriangle& t) const {
  for (const auto& w : Tuning::places) {
    const glm::dvec3 place = w[0] * t.at[0] + w[1] * t.at[1] + w[2] * t.at[2];
    const double limit = Tuning::margin * sizes_.tolerance_at(place);
    const auto foot = below(mesh, place, t.vertex);
    if (foot && glm::distance(foot->position, place) <= limit) continue;
    if (std::abs(distance()(place).distance) > limit) return place;
  }
  return std::nullopt;
}

/// Below x or, where creases bar the way there, the nearest point of these.
SurfacePoint MeshNearness::near(const MeshOnSurface& mesh, const glm::dvec3& x,
                                const std::array<std::uint32_t, 3>& corners) const {
  if (const auto at = below(mesh, x, corners)) return *at;
  SurfacePoint nearest;
  for (const std::uint32_t v : corners)
    if (const auto at = walk_.on_near_cusp(x, mesh.vertex(v).face))
      if (nearest.face == kNone || glm::distance(at->position, x) < glm::distance(nearest.position, x)) nearest = *at;
  return nearest;
}

std::vector<PointAtTriangle> MeshNearness::too_far(MeshOnSurface& mesh) const {
  const HalfEdges& links = mesh.links();
  std::vector<PointAtTriangle> points(links.triangle_count());
  tbb::parallel_for(std::uint32_t{0}, links.triangle_count(), [&](std::uint32_t t) {
    const auto v = links.corners(t);
    if (std::none_of(v.begin(), v.end(), [&](std::uint32_t corner) { return mesh.vertex(corner).changed; })) return;
    if (const auto far = far_place(mesh, mesh.placed(t))) points[t] = {t, near(mesh, *far, v)};
  });
  add_bridges(mesh, points);
  std::erase_if(points, [](const PointAtTriangle& point) { return point.triangle == kNone; });
  for (std::uint32_t v = 0; v < links.vertex_count(); ++v) mesh.vertex(v).changed = false;
  for (const PointAtTriangle& point : points)
    for (const std::uint32_t v : links.corners(point.triangle)) mesh.vertex(v).changed = true;
  return points;
}

void MeshNearness::add_bridges(const MeshOnSurface& mesh, std::vector<PointAtTriangle>& points) const {
  const std::vector<std::array<std::uint32_t, 3>> all = all_triangles(mesh.links());
  const MeshDistance from_mesh(mesh.positions(), all);
  std::vector<NearestTriangle> bridging(to_reach_.size(), {kNone, 0.0});
  tbb::parallel_for(std::size_t{0}, bridging.size(), [&](std::size_t v) {
    const glm::dvec3& x = to_reach_[v].position;
    const double limit = Tuning::margin * sizes_.tolerance_at(x);
    if (from_mesh(x, limit).distance >= limit) bridging[v] = from_mesh(x, std::numeric_limits<double>::infinity());
  });
  std::vector<double> farthest(all.size(), 0.0);
  for (std::size_t v = 0; v < bridging.size(); ++v) {
    const auto& [t, distance] = bridging[v];
    if (t == kNone || distance <= farthest[t]) continue;
    farthest[t] = distance;
    points[t] = {t, to_reach_[v]};
  }
}

bool MeshNearness::reaches_all(const MeshOnSurface& mesh) {
  const TriangleMesh fine = tessellate(surface_, {Tuning::share_of_fine * sizes_.tolerance(), false});
  std::vector<std::uint32_t> face(fine.positions.size());
  for (std::size_t t = 0; t < fine.triangles.size(); ++t)
    for (const std::uint32_t v : fine.triangles[t]) face[v] = fine.face[t];
  const std::vector<std::array<std::uint32_t, 3>> all = all_triangles(mesh.links());
  const MeshDistance from_mesh(mesh.positions(), all);
  std::vector<std::uint8_t> far(face.size());
  tbb::parallel_for(std::size_t{0}, far.size(), [&](std::size_t v) {
    const double limit = sizes_.tolerance_at(fine.positions[v]);
    far[v] = from_mesh(fine.positions[v], limit).distance >= limit;
  });
  bool all_near = true;
  for (std::size_t v = 0; v < far.size(); ++v) {
    if (!far[v]) continue;
    to_reach_.push_back({fine.positions[v], face[v]});
    all_near = false;
  }
  return all_near;
}

}  // namespace meniscus
