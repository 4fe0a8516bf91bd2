// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangles that a change makes, makes changes, and passes over the edges and vertices of a mesh: splits,
// collapses, flips and moves them.
#include "core/mesh/mesh_change.h"

#include <tbb/parallel_for.h>

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

using Tuning = RemeshTuning;

bool Remesher::is_changeable(std::uint32_t half) const {
  const MeshVertex &a = mesh_.vertex(mesh_.links().from(half)), &b = mesh_.vertex(mesh_.links().to(half));
  return (a.active || b.active) && !(a.frozen && b.frozen);
}

std::uint32_t Remesher::split_long(double limit) {
  const HalfEdges& links = mesh_.links();
  const std::uint32_t count = links.half_edge_count();  // new edges come last and wait for the next round
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < count; ++half)
    if (half < links.twin(half) && links.is_alive(half) && is_changeable(half) &&
        mesh_.length(half) > limit * mesh_.wanted(half))
      done += split(half);
  return done;
}

/// Splits an edge, or flips it if its middle is too near to another vertex; returns true if the mesh has changed.
bool Remesher::split(std::uint32_t half) {
  const HalfEdges& links = mesh_.links();
  const auto at = edge_middle(mesh_, half);
  if (!at) return false;
  for (const std::uint32_t c : {links.opposite(half), links.opposite(links.twin(half))})
    if (approaching_ &&
        glm::distance(at->position, mesh_.positions()[c]) < Tuning::nearest_new_vertex * mesh_.length(half))
      return links.crease(half) == kNone && try_flip(half);
  const bool is_guarded = mesh_.guard().is_guarded(links.from(half)) || mesh_.guard().is_guarded(links.to(half));
  if (is_guarded && !is_free_of_crossings(mesh_, {MeshChange::Kind::split, half, *at})) return false;
  mesh_.split(half, *at);
  return true;
}

std::uint32_t Remesher::collapse_short() {
  const HalfEdges& links = mesh_.links();
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (!links.is_alive(half) || half > links.twin(half) || !is_changeable(half)) continue;
    if (mesh_.length(half) < Tuning::shortest_edge * mesh_.wanted(half))
      done += try_collapse(half) || try_collapse(links.twin(half));
  }
  return done;
}

/// Merges the first vertex of an edge into the second if no edge becomes too long and no triangle poor; true if it did.
bool Remesher::try_collapse(std::uint32_t half) {
  const HalfEdges& links = mesh_.links();
  const auto& position = mesh_.positions();
  const std::uint32_t a = links.from(half), b = links.to(half);
  if (mesh_.vertex(a).frozen || !is_mergeable(mesh_, half)) return false;
  bool fits = links.all_leaving(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links.to(edge);
    const double longest = Tuning::longest_edge * 0.5 * (mesh_.vertex(b).size + mesh_.vertex(c).size);
    return c == b || glm::distance(position[b], position[c]) <= longest;
  });
  if (!fits || links.valence(a) + links.valence(b) > Tuning::largest_valence) return false;
  if (!mesh_.can_spare(a)) return false;
  double bar = Tuning::poor_quality;
  bool looked = false;  // true once the bar has been lowered to the present score of the vertex
  WorstQuality after;
  fits = links.all_leaving(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links.to(edge), d = links.opposite(edge);
    if (c == b || d == b) return true;
    after.add(mesh_.quality().of(b, position[b], c, d));
    if (after.score() < bar && !std::exchange(looked, true)) bar = std::min(bar, mesh_.quality().score_around(a));
    return after.score() >= bar;
  });
  const bool is_guarded = mesh_.guard().is_guarded(a) || mesh_.guard().is_guarded(b);
  if (!fits || !links.can_collapse(half)) return false;
  if (is_guarded && !is_free_of_crossings(mesh_, {MeshChange::Kind::collapse, half, {}})) return false;
  mesh_.vertex(b).active = true;
  mesh_.collapse(half);
  return true;
}

/// Flips edges where that improves triangles. Edges between two triangles that have not changed were tested before.
void Remesher::flip_edges() {
  const HalfEdges& links = mesh_.links();
  const TriangleQuality& quality = mesh_.quality();
  mesh_.quality().compute_all();
  std::vector<std::uint8_t> stale = mesh_.quality().take_stale();
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (half > links.twin(half) || !links.is_alive(half)) continue;
    const std::uint32_t t = half / 3, u = links.twin(half) / 3;
    if (!stale[t] && !stale[u]) continue;
    if (quality.of(t) >= Tuning::fine_quality && quality.of(u) >= Tuning::fine_quality) continue;
    if (is_changeable(half) && try_flip(half)) stale[t] = stale[u] = 1;
  }
}

/// Flips an edge if that improves the worse of its two triangles; returns true if it did.
bool Remesher::try_flip(std::uint32_t half) {
  const HalfEdges& links = mesh_.links();
  if (links.crease(half) != kNone) return false;
  const TriangleQuality& quality = mesh_.quality();
  const auto& position = mesh_.positions();
  const std::uint32_t a = links.from(half), b = links.to(half), other = links.twin(half);
  const std::uint32_t c = links.opposite(half), d = links.opposite(other);
  WorstQuality before, after;
  before.add(quality.of(half / 3));
  before.add(quality.of(other / 3));
  const double first = quality.of(d, position[d], c, a);
  after.add(first);
  if (!(after.score() > before.score() + Tuning::score_tolerance)) return false;
  const double second = quality.of(c, position[c], d, b);
  after.add(second);
  if (!(after.score() > before.score() + Tuning::score_tolerance) || !links.can_flip(half)) return false;
  if (links.valence(c) >= Tuning::largest_valence || links.valence(d) >= Tuning::largest_valence) return false;
  const CrossingGuard& guard = mesh_.guard();
  const bool is_guarded = guard.is_guarded(a) || guard.is_guarded(b) || guard.is_guarded(c) || guard.is_guarded(d);
  if (is_guarded && !is_free_of_crossings(mesh_, {MeshChange::Kind::flip, half, {}})) return false;
  mesh_.flip(half, {first, second});
  return true;
}

/// Splits the longest edges first; otherwise halves of triangles would be slivers.
void Remesher::approach() {
  const HalfEdges& links = mesh_.links();
  approaching_ = true;
  mesh_.allow_lean(true);
  flip_edges();
  double longest = 0.0;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half)
    longest = std::max(longest, mesh_.length(half) / mesh_.wanted(half));
  for (double limit = longest / std::sqrt(2.0); limit > Tuning::longest_edge; limit /= std::sqrt(2.0)) {
    split_long(limit);
    flip_edges();
  }
  for (int n = 0; n < Tuning::approach_passes; ++n) {
    const std::uint32_t changes = split_long(Tuning::longest_edge) + collapse_short();
    flip_edges();
    mesh_.compact();
    if (changes < links.triangle_count() / Tuning::few_changes) break;
  }
  approaching_ = false;
  mesh_.allow_lean(false);
}

void Remesher::even_out(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    split_long(Tuning::longest_edge);
    mesh_.quality().compute_all();
    collapse_short();
    flip_edges();
    relax();
    flip_edges();
  }
}

/// Relaxes all vertices. Each moves by where the others were, so their order does not matter; where triangles have to
/// be kept apart they move one after another.
void Remesher::relax() {
  const HalfEdges& links = mesh_.links();
  const std::uint32_t count = links.vertex_count();
  std::vector<std::optional<SurfacePoint>> target(count);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t v) {
    if (mesh_.vertex(v).active && links.is_vertex_alive(v)) target[v] = relaxed(mesh_, v);
  });
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t v) {
    if (target[v] && !mesh_.guard().is_guarded(v)) mesh_.place(v, *target[v]);
  });
  for (std::uint32_t v = 0; v < count; ++v)
    if (target[v] && mesh_.guard().is_guarded(v))
      if (const MeshChange move{MeshChange::Kind::move, v, *target[v]}; is_free_of_crossings(mesh_, move))
        apply_change(mesh_, move);
  tbb::parallel_for(std::uint32_t{0}, links.triangle_count(), [&](std::uint32_t t) {
    if (!links.is_alive(3 * t)) return;
    const auto v = links.corners(t);
    if (target[v[0]] || target[v[1]] || target[v[2]]) mesh_.quality().forget(t);
  });
}

void Remesher::refine(std::span<const std::uint32_t> triangles, double factor) {
  const HalfEdges& links = mesh_.links();
  std::vector<std::uint8_t> is_bad(links.vertex_count(), 0), is_neighbor(is_bad.size(), 0);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : links.corners(t)) is_bad[v] = 1;
  for (std::uint32_t v = 0; v < is_bad.size(); ++v)
    if (is_bad[v]) links.for_each_leaving(v, [&](std::uint32_t half) { is_neighbor[links.to(half)] = 1; });
  for (std::uint32_t v = 0; v < is_bad.size(); ++v) {
    MeshVertex& vertex = mesh_.vertex(v);
    vertex.active = is_bad[v] || is_neighbor[v];
    if (!vertex.active) continue;
    if (vertex.scale > Tuning::finest_scale)
      mesh_.scale_size(v, static_cast<float>(is_bad[v] ? factor : std::sqrt(factor)));
    links.for_each_leaving(v, [&](std::uint32_t half) { mesh_.quality().forget(half / 3); });
  }
}

}  // namespace meniscus
