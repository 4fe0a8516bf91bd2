// SPDX-License-Identifier: BSD-3-Clause
// Finds borders at which faces meet at an angle, which of them a mesh should follow, and which edges of a mesh do.
#include "core/mesh/creases.h"

#include <numeric>

#include "core/mesh/remesh_tuning.h"
#include "core/surface/walks.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

/// Chains of arcs that continue one another.
class Chains {
 public:
  explicit Chains(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Removes chains that are shorter than an edge; returns true if there were any.
bool drop_short_chains(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge,
                       std::vector<bool>& keep) {
  std::vector<std::array<std::uint32_t, 2>> ends(surface.vertices.size(), {kNone, kNone});
  std::vector<std::uint32_t> degree(surface.vertices.size(), 0);
  Chains chains(surface.borders.size());
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    if (!keep[b]) continue;
    for (const std::uint32_t v : surface.borders[b].vertex) {
      if (v == kNone) continue;
      if (degree[v] < 2) ends[v][degree[v]] = b;
      ++degree[v];
    }
  }
  for (std::size_t v = 0; v < degree.size(); ++v)
    if (degree[v] == 2) chains.join(ends[v][0], ends[v][1]);
  std::vector<double> edges_long(surface.borders.size(), 0.0);
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    const Border& border = surface.borders[b];
    if (keep[b])
      edges_long[chains.root(b)] += border.radius * border.sweep / edge(arc_point(border, 0.5 * border.sweep));
  }
  bool any = false;
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b)
    if (keep[b] && edges_long[chains.root(b)] < 1.0) keep[b] = false, any = true;
  return any;
}

/// Returns the first border of a face that counts as a crease and that an edge from a to b runs along, or kNone.
std::uint32_t crease_of(const Surface& surface, const SurfaceWalk& walk, const std::vector<bool>& keep,
                        std::uint32_t face, const glm::dvec3& a, const glm::dvec3& b) {
  const auto on_circle = [](const Border& border, const glm::dvec3& x) {
    const glm::dvec3 out = x - border.center;
    return std::abs(glm::dot(out, border.axis)) < RemeshTuning::on_crease &&
           std::abs(glm::length(out) - border.radius) < RemeshTuning::on_crease;
  };
  std::uint32_t found = kNone;
  for_each_half_border(surface, surface.faces[face], [&](HalfBorder half) {
    const std::uint32_t n = border_of(half);
    if (!keep[n] || !on_circle(surface.borders[n], a) || !on_circle(surface.borders[n], b)) return;
    if (walk.on_border(0.5 * (a + b), n)) found = std::min(found, n);
  });
  return found;
}

}  // namespace

std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x) {
  std::array<glm::dvec3, 2> normal{};
  if (border.kind == BorderKind::cusp) {
    for (int side = 0; side < 2; ++side)
      normal[side] = glm::normalize(surface.concave[surface.faces[border.face[side]].patch].center - x);
  } else if (border.kind == BorderKind::contact && surface.probe_radius == 0.0) {
    for (int side = 0; side < 2; ++side) {  // tori have no faces here
      const ConvexPatch& patch = surface.convex[surface.faces[border.face[side]].patch];
      normal[side] = glm::normalize(x - surface.atoms[patch.atom].center);
    }
  }
  return normal;
}

double crease_angle(const Surface& surface, const Border& border) {
  const auto normal = crease_normals(surface, border, arc_point(border, 0.5 * border.sweep));
  return std::atan2(glm::length(glm::cross(normal[0], normal[1])), glm::dot(normal[0], normal[1]));
}

std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge) {
  std::vector<bool> keep(surface.borders.size(), false);
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    const Border& border = surface.borders[b];
    const double angle = crease_angle(surface, border);
    if (angle == 0.0) continue;
    const double radius = surface.probe_radius > 0.0 ? surface.probe_radius : border.radius;
    keep[b] = std::sin(0.5 * angle) > 0.5 * edge(arc_point(border, 0.5 * border.sweep)) / radius;
  }
  while (drop_short_chains(surface, edge, keep)) {
  }
  return keep;
}

void mark_creases(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& mesh,
                  const std::vector<bool>& keep, HalfEdges& links) {
  std::vector<bool> with_crease(surface.faces.size(), false);
  for (std::uint32_t b = 0; b < keep.size(); ++b)
    if (keep[b])
      for (const std::uint32_t f : surface.borders[b].face) with_crease[f] = true;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    const std::uint32_t f = mesh.face[half / 3], g = mesh.face[links.twin(half) / 3];
    if (f == g || half > links.twin(half) || !with_crease[f] || !with_crease[g]) continue;
    // If the probe radius is 0, borders on both sides have the same points; the first one represents both.
    const glm::dvec3 &a = mesh.positions[links.from(half)], &b = mesh.positions[links.to(half)];
    const std::uint32_t border =
        std::min(crease_of(surface, walk, keep, f, a, b), crease_of(surface, walk, keep, g, a, b));
    if (border != kNone) links.set_crease(half, border);
  }
}

std::vector<CreaseAt> creases_at_vertices(const HalfEdges& links) {
  std::vector<CreaseAt> found(links.vertex_count());
  std::vector<std::uint32_t> count(found.size(), 0);
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    const std::uint32_t border = links.crease(half), v = links.from(half);
    if (border == kNone) continue;
    if (count[v]++ > 0 && found[v].border != border) found[v].ends = true;
    found[v].border = border;
  }
  for (std::size_t v = 0; v < found.size(); ++v)
    if (count[v] != 0 && count[v] != 2) found[v].ends = true;
  return found;
}

}  // namespace meniscus
