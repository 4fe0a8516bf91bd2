// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangles that a change of a mesh makes, makes changes, and finds places for vertices on the surface.
#include "core/mesh/mesh_change.h"

#include <glm/geometric.hpp>

#include "core/mesh/remesh_tuning.h"

namespace meniscus {

TriangleExchange exchange_by(const MeshOnSurface& mesh, const MeshChange& change) {
  TriangleExchange all;
  all.made.reserve(RemeshTuning::largest_mended_valence);
  all.removed.reserve(RemeshTuning::largest_mended_valence);
  for_each_made(mesh, change, [&](const PlacedTriangle& t) { all.made.push_back(t); });
  for_each_removed(mesh, change, [&](std::uint32_t t) { all.removed.push_back(t); });
  return all;
}

bool is_mergeable(const MeshOnSurface& mesh, std::uint32_t half) {
  const HalfEdges& links = mesh.links();
  const MeshVertex& vertex = mesh.vertex(links.from(half));
  if (vertex.pinned) return false;
  if (vertex.crease != kNone && links.crease(half) != vertex.crease) return false;
  const auto joins_creases = [&](std::uint32_t side) {
    return links.crease(HalfEdges::next(side)) != kNone && links.crease(HalfEdges::last(side)) != kNone;
  };
  return !joins_creases(half) && !joins_creases(links.twin(half));
}

bool is_free_of_crossings(const MeshOnSurface& mesh, const MeshChange& change) {
  const TriangleExchange all = exchange_by(mesh, change);
  return mesh.guard().crossings(all.made, all.removed, 1) == 0;
}

void apply_change(MeshOnSurface& mesh, const MeshChange& change) {
  switch (change.kind) {
    case MeshChange::Kind::flip:
      mesh.flip(change.where);
      break;
    case MeshChange::Kind::collapse: {
      const MeshVertex& from = mesh.vertex(mesh.links().from(change.where));
      if (from.on_crease() && (mesh.links().crease(change.where) == kNone || from.pinned))
        mesh.vertex(mesh.links().to(change.where)).pinned = true;
      mesh.collapse(change.where);
      break;
    }
    case MeshChange::Kind::split:
      mesh.split(change.where, change.at);
      break;
    case MeshChange::Kind::poke:
      mesh.poke(change.where, change.at);
      break;
    case MeshChange::Kind::move:
      mesh.move(change.where, change.at);
  }
}

std::optional<SurfacePoint> edge_middle(const MeshOnSurface& mesh, std::uint32_t half) {
  const SurfaceWalk& walk = mesh.walk();
  const SurfacePoint a = mesh.point(mesh.links().from(half)), b = mesh.point(mesh.links().to(half));
  const std::uint32_t border = mesh.links().crease(half);
  const glm::dvec3 middle = 0.5 * (a.position + b.position);
  std::optional<SurfacePoint> at;
  if (border != kNone) {
    if (const auto on = walk.on_border(middle, border)) at = SurfacePoint{*on, mesh.surface().borders[border].face[0]};
  } else {
    at = walk.below(middle, a.face);
    if (!at) at = walk.below(middle, b.face);
  }
  const double deepest = RemeshTuning::deepest_foot * mesh.length(half);
  if (border == kNone && (!at || glm::distance(at->position, middle) > deepest)) at = walk.on_near_cusp(middle, a.face);
  if (at && glm::distance(at->position, middle) > deepest) return std::nullopt;
  return at;
}

std::optional<glm::dvec3> crease_middle(const MeshOnSurface& mesh, std::uint32_t vertex) {
  glm::dvec3 sum(0.0);
  int count = 0;
  mesh.links().for_each_leaving(vertex, [&](std::uint32_t half) {
    if (mesh.links().crease(half) == kNone) return;
    sum += mesh.positions()[mesh.links().to(half)];
    ++count;
  });
  if (count != 2) return std::nullopt;
  return 0.5 * sum;
}

glm::dvec3 centroid_around(const MeshOnSurface& mesh, std::uint32_t vertex) {
  const auto& position = mesh.positions();
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  const glm::dvec3& x = position[vertex];
  mesh.links().for_each_leaving(vertex, [&](std::uint32_t half) {
    const glm::dvec3 u = position[mesh.links().to(half)] - x, v = position[mesh.links().opposite(half)] - x;
    const double area = glm::length(glm::cross(u, v));
    sum += area / 3.0 * (u + v);
    weight += area;
  });
  return weight > 0.0 ? x + sum / weight : x;
}

std::optional<SurfacePoint> relaxed(const MeshOnSurface& mesh, std::uint32_t vertex) {
  const MeshVertex& v = mesh.vertex(vertex);
  if (v.pinned || v.frozen) return std::nullopt;
  const glm::dvec3& x = mesh.positions()[vertex];
  SurfacePoint target;
  if (v.crease != kNone) {
    const auto middle = crease_middle(mesh, vertex);
    if (!middle) return std::nullopt;
    const auto on = mesh.walk().on_border(x + RemeshTuning::relaxation * (*middle - x), v.crease);
    if (!on) return std::nullopt;
    target = {*on, v.face};
  } else {
    glm::dvec3 move = RemeshTuning::relaxation * (centroid_around(mesh, vertex) - x);
    move -= glm::dot(move, v.normal) * v.normal;
    if (glm::length(move) < RemeshTuning::shortest_step * v.size) return std::nullopt;
    const auto at = mesh.walk().below(x + move, v.face);
    if (!at || glm::distance(at->position, x) > v.size) return std::nullopt;
    target = *at;
  }
  const double score = mesh.quality().score_around(vertex, target.position);
  if (score < RemeshTuning::poor_quality && score < mesh.quality().score_around(vertex)) return std::nullopt;
  return target;
}

}  // namespace meniscus
