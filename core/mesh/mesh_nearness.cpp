// SPDX-License-Identifier: BSD-3-Clause
// Measures how far an even mesh is from its surface at places in its triangles, and the surface from it at points.
#include "core/mesh/mesh_nearness.h"

#include <tbb/parallel_for.h>

#include "core/mesh/compare_mesh.h"
#include "core/mesh/tessellate.h"
#include "core/surface/walks.h"

namespace meniscus {

using Tuning = RemeshTuning;

namespace {

/// Returns a key of three corners in any order, which a triangle keeps while its indices change.
std::uint64_t key_of(std::span<const glm::dvec3> positions, const std::array<std::uint32_t, 3>& triangle) {
  std::uint64_t key = 0;
  for (const std::uint32_t v : triangle) {
    std::uint64_t bits = 0;
    for (int k = 0; k < 3; ++k)
      bits = (bits ^ std::bit_cast<std::uint64_t>(positions[v][k])) * 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio
    key += bits ^ (bits >> 32);
  }
  return key;
}

/// The set of the keys of all triangles of a mesh.
class TriangleKeys {
 public:
  TriangleKeys(std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles)
      : slots_(std::bit_ceil(2 * triangles.size() + 1), kNone), keys_(triangles.size()) {
    tbb::parallel_for(std::size_t{0}, keys_.size(), [&](std::size_t t) { keys_[t] = key_of(positions, triangles[t]); });
    for (std::uint32_t t = 0; t < keys_.size(); ++t) slots_[slot(keys_[t])] = t;
  }
  std::uint64_t of(std::uint32_t triangle) const { return keys_[triangle]; }
  bool contain(std::uint64_t key) const { return slots_[slot(key)] != kNone; }

 private:
  /// Returns the slot of this key, or the empty one where it would be.
  std::size_t slot(std::uint64_t key) const {
    std::size_t at = key & (slots_.size() - 1);
    while (slots_[at] != kNone && keys_[slots_[at]] != key) at = (at + 1) & (slots_.size() - 1);
    return at;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<std::uint64_t> keys_;
};

}  // namespace

std::optional<SurfacePoint> below(const MeshOnSurface& mesh, const glm::dvec3& x,
                                  const std::array<std::uint32_t, 3>& corners) {
  for (const bool smooth : {true, false})  // a vertex of a crease is on both sides of it
    for (const std::uint32_t v : corners) {
      if (v >= mesh.positions().size() || mesh.vertex(v).on_crease() == smooth) continue;
      if (const auto at = mesh.walk().below(x, mesh.vertex(v).face)) return at;
    }
  return std::nullopt;
}

void MeshNearness::set_targets(const BaseMesh& base) {
  const TriangleMesh& mesh = base.mesh;
  targets_.clear();
  near_keys_.clear();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) targets_.push_back({mesh.positions[v], base.vertex_face[v]});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    if (const auto at = walk_.below(middle, mesh.face[t])) targets_.push_back(*at);
  }
  for (const Border& border : surface_.borders) {
    if (surface_.probe_radius == 0.0 || crease_angle(surface_, border) == 0.0) continue;
    const double step = Tuning::crease_step * sizes_.tolerance_at(arc_point(border, 0.5 * border.sweep));
    const auto count = static_cast<std::uint32_t>(std::ceil(border.radius * border.sweep / step));
    for (std::uint32_t k = 1; k < count; ++k)
      targets_.push_back({arc_point(border, border.sweep * k / count), border.face[0]});
  }
}

const SurfaceDistance& MeshNearness::distance() const {
  std::call_once(distance_made_, [&] { distance_.emplace(surface_); });
  return *distance_;
}

std::optional<glm::dvec3> MeshNearness::find_far_place(const MeshOnSurface& mesh, const PlacedTriangle& t) const {
  for (const auto& w : Tuning::sample_weights) {
    const glm::dvec3 place = w[0] * t.at[0] + w[1] * t.at[1] + w[2] * t.at[2];
    const double limit = Tuning::margin * sizes_.tolerance_at(place);
    const auto foot = below(mesh, place, t.vertex);
    if (foot && glm::distance(foot->position, place) <= limit) continue;
    if (!distance().is_within(place, limit)) return place;
  }
  return std::nullopt;
}

/// Returns the point below x or, if creases bar the way there, the nearest point of these.
SurfacePoint MeshNearness::nearest_point(const MeshOnSurface& mesh, const glm::dvec3& x,
                                         const std::array<std::uint32_t, 3>& corners) const {
  if (const auto at = below(mesh, x, corners)) return *at;
  SurfacePoint nearest;
  for (const std::uint32_t v : corners)
    if (const auto at = walk_.on_near_cusp(x, mesh.vertex(v).face))
      if (nearest.face == kNone || glm::distance(at->position, x) < glm::distance(nearest.position, x)) nearest = *at;
  return nearest;
}

std::vector<PointAtTriangle> MeshNearness::find_far_triangles(MeshOnSurface& mesh) {
  const HalfEdges& links = mesh.links();
  std::vector<PointAtTriangle> points(links.triangle_count());
  tbb::parallel_for(std::uint32_t{0}, links.triangle_count(), [&](std::uint32_t t) {
    const auto v = links.corners(t);
    if (std::none_of(v.begin(), v.end(), [&](std::uint32_t corner) { return mesh.vertex(corner).changed; })) return;
    if (const auto far = find_far_place(mesh, mesh.placed(t))) points[t] = {t, nearest_point(mesh, *far, v)};
  });
  add_bridges(mesh, points);
  std::erase_if(points, [](const PointAtTriangle& point) { return point.triangle == kNone; });
  for (std::uint32_t v = 0; v < links.vertex_count(); ++v) mesh.vertex(v).changed = false;
  for (const PointAtTriangle& point : points)
    for (const std::uint32_t v : links.corners(point.triangle)) mesh.vertex(v).changed = true;
  return points;
}

/// Adds the triangles nearest to places that are too far from the mesh.
void MeshNearness::add_bridges(const MeshOnSurface& mesh, std::vector<PointAtTriangle>& points) {
  const std::vector<std::array<std::uint32_t, 3>> all = all_triangles(mesh.links());
  const TriangleKeys keys(mesh.positions(), all);
  near_keys_.resize(targets_.size(), 0);
  std::vector<std::uint8_t> unknown(targets_.size());
  tbb::parallel_for(std::size_t{0}, unknown.size(), [&](std::size_t v) { unknown[v] = !keys.contain(near_keys_[v]); });
  std::vector<std::uint32_t> queries;
  for (std::uint32_t v = 0; v < unknown.size(); ++v)
    if (unknown[v]) queries.push_back(v);
  if (queries.empty()) return;
  const MeshDistance from_mesh(mesh.positions(), all);
  std::vector<NearestTriangle> bridging(queries.size(), {kNone, 0.0});
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t n) {
    const glm::dvec3& x = targets_[queries[n]].position;
    const double limit = Tuning::margin * sizes_.tolerance_at(x);
    const std::uint32_t near = from_mesh.any_within(x, limit);
    if (near < all.size())
      near_keys_[queries[n]] = keys.of(near);
    else
      bridging[n] = from_mesh(x, std::numeric_limits<double>::infinity());
  });
  std::vector<double> farthest(all.size(), 0.0);
  for (std::size_t n = 0; n < bridging.size(); ++n) {
    const auto& [t, distance] = bridging[n];
    if (t == kNone || distance <= farthest[t]) continue;
    farthest[t] = distance;
    points[t] = {t, targets_[queries[n]]};
  }
}

/// Returns the vertices of a mesh that is finer than the tolerance; they are the same for all attempts.
const std::vector<SurfacePoint>& MeshNearness::fine_vertices() {
  if (!fine_vertices_.empty()) return fine_vertices_;
  const TriangleMesh fine = tessellate(surface_, {Tuning::fine_tolerance_share * sizes_.tolerance(), false});
  fine_vertices_.resize(fine.positions.size());
  for (std::size_t v = 0; v < fine_vertices_.size(); ++v) fine_vertices_[v].position = fine.positions[v];
  for (std::size_t t = 0; t < fine.triangles.size(); ++t)
    for (const std::uint32_t v : fine.triangles[t]) fine_vertices_[v].face = fine.face[t];
  return fine_vertices_;
}

bool MeshNearness::reaches_fine_vertices(const MeshOnSurface& mesh) {
  const std::vector<SurfacePoint>& fine = fine_vertices();
  const std::vector<std::array<std::uint32_t, 3>> all = all_triangles(mesh.links());
  const MeshDistance from_mesh(mesh.positions(), all);
  std::vector<std::uint8_t> far(fine.size());
  tbb::parallel_for(std::size_t{0}, far.size(), [&](std::size_t v) {
    const double limit = sizes_.tolerance_at(fine[v].position);
    far[v] = from_mesh.any_within(fine[v].position, limit) == all.size();
  });
  bool all_near = true;
  for (std::size_t v = 0; v < far.size(); ++v) {
    if (!far[v]) continue;
    targets_.push_back(fine[v]);
    all_near = false;
  }
  return all_near;
}

}  // namespace meniscus
