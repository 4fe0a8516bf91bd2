// SPDX-License-Identifier: BSD-3-Clause
// Passes over the edges and vertices of a mesh on a surface: splits, collapses, flips and moves them.
#include "core/mesh/remesher.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/mesh/mesh_change.h"
#include "core/mesh/remesh_tuning.h"

namespace meniscus {

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

/// Merges the first vertex of an edge into the second if no edge becomes too long and no triangle poor; returns true if
/// it did.
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
