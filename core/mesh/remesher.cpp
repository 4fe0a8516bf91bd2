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
#include "core/mesh/even_sizes.h"

namespace meniscus {

using Tuning = RemeshTuning;

bool Remesher::busy(std::uint32_t half) const {
  const MeshVertex &a = mesh_.vertex(mesh_.links().from(half)), &b = mesh_.vertex(mesh_.links().to(half));
  return (a.active || b.active) && !(a.frozen && b.frozen);
}

std::uint32_t Remesher::split_long(double limit) {
  const HalfEdges& links = mesh_.links();
  const std::uint32_t count = links.half_edge_count();  // new edges come last and wait for the next round
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < count; ++half)
    if (half < links.twin(half) && links.lives(half) && busy(half) && mesh_.length(half) > limit * mesh_.wanted(half))
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
  const bool watched = mesh_.guard().watches(links.from(half)) || mesh_.guard().watches(links.to(half));
  if (watched && !crosses_nothing(mesh_, {MeshChange::Kind::split, half, *at})) return false;
  mesh_.split(half, *at);
  return true;
}

std::uint32_t Remesher::collapse_short() {
  const HalfEdges& links = mesh_.links();
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (!links.lives(half) || half > links.twin(half) || !busy(half)) continue;
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
  if (mesh_.vertex(a).frozen || !may_vanish(mesh_, half)) return false;
  bool fits = links.all_around(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links.to(edge);
    const double longest = Tuning::longest_edge * 0.5 * (mesh_.vertex(b).size + mesh_.vertex(c).size);
    return c == b || glm::distance(position[b], position[c]) <= longest;
  });
  if (!fits || links.valence(a) + links.valence(b) > Tuning::most_edges) return false;
  if (!mesh_.can_spare(a)) return false;
  double bar = Tuning::poor_quality;
  bool looked = false;  // true once the bar has been lowered to the present score of the vertex
  WorstQuality after;
  fits = links.all_around(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links.to(edge), d = links.opposite(edge);
    if (c == b || d == b) return true;
    after.add(mesh_.quality().of(b, position[b], c, d));
    if (after.score() < bar && !std::exchange(looked, true)) bar = std::min(bar, mesh_.quality().score_around(a));
    return after.score() >= bar;
  });
  const bool watched = mesh_.guard().watches(a) || mesh_.guard().watches(b);
  if (!fits || !links.can_collapse(half)) return false;
  if (watched && !crosses_nothing(mesh_, {MeshChange::Kind::collapse, half, {}})) return false;
  mesh_.vertex(b).active = true;
  mesh_.collapse(half);
  return true;
}

/// Flips edges where that improves triangles. Edges between two triangles that have not changed were tested before.
void Remesher::flip_edges() {
  const HalfEdges& links = mesh_.links();
  const TriangleQuality& quality = mesh_.quality();
  mesh_.quality().find_all();
  std::vector<std::uint8_t> stale = mesh_.quality().take_stale();
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (half > links.twin(half) || !links.lives(half)) continue;
    const std::uint32_t t = half / 3, u = links.twin(half) / 3;
    if (!stale[t] && !stale[u]) continue;
    if (quality.of(t) >= Tuning::fine_quality && quality.of(u) >= Tuning::fine_quality) continue;
    if (busy(half) && try_flip(half)) stale[t] = stale[u] = 1;
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
  if (!(after.score() > before.score() + Tuning::better)) return false;
  const double second = quality.of(c, position[c], d, b);
  after.add(second);
  if (!(after.score() > before.score() + Tuning::better) || !links.can_flip(half)) return false;
  if (links.valence(c) >= Tuning::most_edges || links.valence(d) >= Tuning::most_edges) return false;
  const CrossingGuard& guard = mesh_.guard();
  const bool watched = guard.watches(a) || guard.watches(b) || guard.watches(c) || guard.watches(d);
  if (watched && !crosses_nothing(mesh_, {MeshChange::Kind::flip, half, {}})) return false;
  mesh_.flip(half, {first, second});
  return true;
}

/// Splits the longest edges first; otherwise halves of triangles would be slivers.
void Remesher::approach() {
  const HalfEdges& links = mesh_.links();
  approaching_ = true;
  mesh_.let_lean(true);
  flip_edges();
  double longest = 0.0;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half)
    longest = std::max(longest, mesh_.length(half) / mesh_.wanted(half));
  for (double limit = longest / std::sqrt(2.0); limit > Tuning::longest_edge; limit /= std::sqrt(2.0)) {
    split_long(limit);
    flip_edges();
  }
  for (int n = 0; n < Tuning::approaches; ++n) {
    const std::uint32_t changes = split_long(Tuning::longest_edge) + collapse_short();
    flip_edges();
    mesh_.compact();
    if (changes < links.triangle_count() / Tuning::few_changes) break;
  }
  approaching_ = false;
  mesh_.let_lean(false);
}

void Remesher::even_out(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    split_long(Tuning::longest_edge);
    mesh_.quality().find_all();
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
    if (mesh_.vertex(v).active && links.vertex_lives(v)) target[v] = relaxed(mesh_, v);
  });
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t v) {
    if (target[v] && !mesh_.guard().watches(v)) mesh_.place(v, *target[v]);
  });
  for (std::uint32_t v = 0; v < count; ++v)
    if (target[v] && mesh_.guard().watches(v))
      if (const MeshChange move{MeshChange::Kind::move, v, *target[v]}; crosses_nothing(mesh_, move)) make(mesh_, move);
  tbb::parallel_for(std::uint32_t{0}, links.triangle_count(), [&](std::uint32_t t) {
    if (!links.lives(3 * t)) return;
    const auto v = links.corners(t);
    if (target[v[0]] || target[v[1]] || target[v[2]]) mesh_.quality().forget(t);
  });
}

void Remesher::refine(std::span<const std::uint32_t> triangles, double factor) {
  const HalfEdges& links = mesh_.links();
  std::vector<std::uint8_t> bad(links.vertex_count(), 0), beside(bad.size(), 0);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : links.corners(t)) bad[v] = 1;
  for (std::uint32_t v = 0; v < bad.size(); ++v)
    if (bad[v]) links.around(v, [&](std::uint32_t half) { beside[links.to(half)] = 1; });
  for (std::uint32_t v = 0; v < bad.size(); ++v) {
    MeshVertex& vertex = mesh_.vertex(v);
    vertex.active = bad[v] || beside[v];
    if (!vertex.active) continue;
    if (vertex.scale > Tuning::finest_scale)
      mesh_.scale_size(v, static_cast<float>(bad[v] ? factor : std::sqrt(factor)));
    links.around(v, [&](std::uint32_t half) { mesh_.quality().forget(half / 3); });
  }
}

}  // namespace meniscus
