// SPDX-License-Identifier: BSD-3-Clause
// Tries all small changes at a bad triangle of a mesh and makes the best one, as long as there is one that helps.
#include "core/mesh/mesh_mender.h"

#include <unordered_map>

#include <tbb/parallel_for.h>

#include "core/mesh/remesh_tuning.h"

namespace meniscus {

using Tuning = RemeshTuning;
using Kind = MeshChange::Kind;

namespace {

/// The result of fault_reduction() for a change that adds faults.
constexpr std::ptrdiff_t kWorse = -1;

/// True if no edge is too long once the first vertex of this one is merged into the second.
bool stays_short(const MeshOnSurface& mesh, std::uint32_t half) {
  const HalfEdges& links = mesh.links();
  const std::uint32_t b = links.to(half);
  bool fits = true;
  links.for_each_leaving(links.from(half), [&](std::uint32_t edge) {
    const std::uint32_t c = links.to(edge);
    const double longest = Tuning::too_long * 0.5 * (mesh.vertex(b).size + mesh.vertex(c).size);
    fits = fits && glm::distance(mesh.positions()[b], mesh.positions()[c]) <= longest;
  });
  return fits;
}

}  // namespace

bool MeshMender::is_too_short(std::uint32_t half) const {
  return mesh_.length(half) < Tuning::too_short * mesh_.wanted(half);
}

/// True if the first vertex of an edge may be merged into the second. This includes short edges at the ends of creases,
/// which would otherwise remain slivers forever.
bool MeshMender::may_merge(std::uint32_t half) const { return is_mergeable(mesh_, half) || is_too_short(half); }

/// Returns a triangle's quality with a placed vertex. If `steep`, triangles may lean almost upright on the surface.
double MeshMender::quality(const PlacedTriangle& t, const PlacedVertex& placed, bool steep) const {
  const glm::dvec3 normal = glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]);
  const double size = glm::length(normal);
  if (!(size > 0.0)) return -kFold;
  double squares = 0.0;
  bool folded = false;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = t.vertex[k];
    const glm::dvec3 edge = t.at[(k + 1) % 3] - t.at[k];
    squares += glm::dot(edge, edge);
    const bool is_placed = v == placed.vertex;
    if (is_placed ? placed.on_crease : mesh_.vertex(v).on_crease()) continue;
    const double cosine = steep       ? Tuning::least_cosine
                          : is_placed ? placed.least_cosine
                                      : static_cast<double>(mesh_.vertex(v).least_cosine);
    folded = folded || !(glm::dot(normal, is_placed ? placed.normal : mesh_.vertex(v).normal) > cosine * size);
  }
  const double quality = 2.0 * std::sqrt(3.0) * size / squares;
  return folded ? quality - kFold : quality;
}

/// Returns the score of the triangles that a change makes. Scores that are no better than `bar` are not computed to the
/// end.
double MeshMender::score_after(const MeshChange& change, bool steep, double bar) const {
  const bool moving = change.kind == Kind::move, splitting = change.kind == Kind::split;
  PlacedVertex placed;
  if (change.places_vertex()) {
    const HalfEdges& links = mesh_.links();
    const std::uint32_t similar = moving ? change.where : links.from(splitting ? change.where : 3 * change.where);
    placed.vertex = moving ? change.where : links.vertex_count();
    placed.normal = mesh_.walk().normal(change.at);
    placed.least_cosine = mesh_.vertex(similar).least_cosine;
    placed.on_crease =
        moving ? mesh_.vertex(change.where).on_crease() : splitting && links.crease(change.where) != kNone;
  }
  WorstQuality worst;
  for_each_made(mesh_, change, [&](const PlacedTriangle& t) {
    if (worst.score() > bar) worst.add(quality(t, placed, steep));
  });
  return worst.score();
}

/// Returns the score of the triangles that a change removes.
double MeshMender::score_before(const MeshChange& change, bool steep) const {
  WorstQuality worst;
  for_each_removed(mesh_, change, [&](std::uint32_t t) {
    worst.add(steep ? quality(mesh_.placed(t), {}, true) : mesh_.quality().of(t));
  });
  return worst.score();
}

/// Calls visit(place) for the places where a vertex may go.
template <typename Visit>
void MeshMender::for_each_place(std::uint32_t vertex, const Visit& visit) const {
  const MeshVertex& v = mesh_.vertex(vertex);
  if (v.pinned) return;
  const SurfaceWalk& walk = mesh_.walk();
  const glm::dvec3& x = mesh_.positions()[vertex];
  const double size = v.size;
  if (v.crease != kNone) {
    const auto middle = crease_middle(mesh_, vertex);
    if (!middle) return;
    for (const double share : Tuning::crease_shares)
      if (const auto on = walk.on_border(x + share * (*middle - x), v.crease)) visit({*on, v.face});
    return;
  }
  const auto visit_below = [&](const glm::dvec3& y) {
    if (const auto at = walk.below(y, v.face); at && glm::distance(at->position, x) < size) visit(*at);
  };
  const glm::dvec3 to_middle = centroid_around(mesh_, vertex) - x, n = v.normal;
  for (const double share : Tuning::shares) visit_below(x + share * to_middle);
  glm::dvec3 u = glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  u = glm::normalize(u);
  const glm::dvec3 w = glm::cross(n, u);
  std::array<glm::dvec3, Tuning::directions> along;
  for (int k = 0; k < Tuning::directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / Tuning::directions;
    along[k] = std::cos(angle) * u + std::sin(angle) * w;
  }
  for (const double step : Tuning::steps)
    for (const glm::dvec3& direction : along) visit_below(x + step * size * direction);
}

/// Calls visit(change, score of the triangles that it removes) for all small changes of a triangle.
template <typename Visit>
void MeshMender::for_each_change(std::uint32_t triangle, bool steep, const Visit& visit) const {
  const HalfEdges& links = mesh_.links();
  const auto offer = [&](const MeshChange& change) { visit(change, score_before(change, steep)); };
  for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
    const std::uint32_t other = links.twin(half);
    const std::uint32_t c = links.opposite(half), d = links.opposite(other);
    const bool valence_allows =
        links.valence(c) < Tuning::largest_mended_valence && links.valence(d) < Tuning::largest_mended_valence;
    if (valence_allows && links.can_flip(half)) offer({Kind::flip, half, {}});
    if (links.valence(links.from(half)) + links.valence(links.to(half)) < Tuning::largest_mended_valence + 4)
      for (const std::uint32_t side : {half, other})
        if (may_merge(side) && stays_short(mesh_, side) && links.can_collapse(side) &&
            mesh_.can_spare(links.from(side)))
          offer({Kind::collapse, side, {}});
    if (valence_allows && mesh_.length(half) > 2.0 * Tuning::too_short * mesh_.wanted(half))
      if (const auto at = edge_middle(mesh_, half)) offer({Kind::split, half, *at});
  }
  for (const std::uint32_t v : links.corners(triangle)) {
    const double now = score_before({Kind::move, v, {}}, steep);
    for_each_place(v, [&](const SurfacePoint& at) { visit(MeshChange{Kind::move, v, at}, now); });
  }
}

/// True if a triangle crosses others or is not allowed.
bool MeshMender::is_faulty(std::uint32_t triangle) const {
  const PlacedTriangle x = mesh_.placed(triangle);
  return mesh_.guard().crossings({&x, 1}, {&triangle, 1}) > 0 || !allowed_(x);
}

/// Caches faults, since the changes at a triangle remove the same triangles again and again.
class MeshMender::FaultCache {
 public:
  /// Both arguments must outlive this object.
  FaultCache(const MeshOnSurface& mesh, const Allowed& allowed) : mesh_(mesh), allowed_(allowed) {}

  /// Returns how many of these triangles are not allowed.
  std::size_t forbidden(std::span<const std::uint32_t> removed) {
    std::size_t count = 0;
    for (const std::uint32_t t : removed) {
      const auto [known, is_new] = forbidden_.try_emplace(t, false);
      if (is_new) known->second = !allowed_(mesh_.placed(t));
      count += known->second;
    }
    return count;
  }
  /// Returns the number of crossing pairs that contain one of these triangles.
  std::size_t crossings(const std::vector<std::uint32_t>& removed) {
    if (removed == removed_) return crossings_;
    std::vector<PlacedTriangle> now;
    now.reserve(removed.size());
    for (const std::uint32_t t : removed) now.push_back(mesh_.placed(t));
    removed_ = removed;
    return crossings_ = mesh_.guard().crossings(now, removed);
  }

 private:
  const MeshOnSurface& mesh_;
  const Allowed& allowed_;
  std::unordered_map<std::uint32_t, bool> forbidden_;
  std::vector<std::uint32_t> removed_;  ///< the triangles of the last query
  std::size_t crossings_ = 0;           ///< number of their crossings
};

/// Returns how many of these triangles are not allowed; stops counting at `enough`.
std::size_t MeshMender::forbidden(std::span<const PlacedTriangle> made, std::size_t enough) const {
  std::size_t count = 0;
  for (const PlacedTriangle& t : made)
    if (!allowed_(t) && ++count == enough) break;
  return count;
}

/// Returns by how much a change reduces the forbidden triangles and the crossing pairs together; kWorse if it adds any
/// of either.
std::ptrdiff_t MeshMender::fault_reduction(const TriangleExchange& exchange, FaultCache& faults) const {
  const std::size_t are_forbidden = faults.forbidden(exchange.removed),
                    will_be = forbidden(exchange.made, are_forbidden + 1);
  if (will_be > are_forbidden) return kWorse;
  const std::size_t cross = faults.crossings(exchange.removed);
  const std::size_t will_cross = mesh_.guard().crossings(exchange.made, exchange.removed, cross + 1);
  if (will_cross > cross) return kWorse;
  return static_cast<std::ptrdiff_t>(are_forbidden - will_be + cross - will_cross);
}

/// True if a triangle is a sliver, around which all triangles may lean.
bool MeshMender::is_sliver(std::uint32_t triangle) const {
  return quality(mesh_.placed(triangle), {}, true) < Tuning::sliver_quality;
}

/// Returns the changes after which the worst triangle is better, or a short edge is gone and the worst one no worse.
MeshMender::Candidates MeshMender::better_changes(std::uint32_t triangle) const {
  const bool sliver = is_sliver(triangle);
  Candidates candidates;
  for_each_change(triangle, sliver, [&](const MeshChange& change, double now) {
    const bool shortens = change.kind == Kind::collapse && is_too_short(change.where);
    const double bar = now + (shortens ? -Tuning::score_tolerance : Tuning::score_tolerance),
                 score = score_after(change, sliver, bar);
    if (score > bar) candidates.push_back({0, score - now, change});
  });
  sort_candidates(candidates, sliver);
  return candidates;
}

/// Returns the changes after which fewer triangles cross others or are forbidden.
MeshMender::Candidates MeshMender::repairing_changes(std::uint32_t triangle) const {
  const bool sliver = is_sliver(triangle);
  Candidates candidates;
  FaultCache faults(mesh_, allowed_);
  for_each_change(triangle, sliver, [&](const MeshChange& change, double now) {
    if (const std::ptrdiff_t fewer = fault_reduction(exchange_by(mesh_, change), faults); fewer > 0)
      candidates.push_back({fewer, score_after(change, sliver) - now, change});
  });
  sort_candidates(candidates, sliver);
  return candidates;
}

/// Sorts candidates, the best first, and keeps the first Tuning::checked_candidates, or all of a sliver.
void MeshMender::sort_candidates(Candidates& candidates, bool sliver) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.fewer_faults != b.fewer_faults ? a.fewer_faults > b.fewer_faults : a.gain > b.gain;
  });
  if (!sliver && candidates.size() > Tuning::checked_candidates)
    candidates.erase(candidates.begin() + Tuning::checked_candidates, candidates.end());
}

/// Makes the first change that causes no fault; returns false if there is none.
bool MeshMender::apply_first(const Candidates& candidates) {
  FaultCache faults(mesh_, allowed_);
  for (const Candidate& candidate : candidates) {
    const MeshChange& change = candidate.change;
    if (change.kind == Kind::collapse && !mesh_.can_spare(mesh_.links().from(change.where))) continue;
    const TriangleExchange all = exchange_by(mesh_, change);
    if (candidate.fewer_faults == 0) {
      if (mesh_.guard().crossings(all.made, all.removed, 1) > 0) continue;
      const std::size_t will_be = forbidden(all.made, all.made.size());
      if (will_be > 0 && will_be > faults.forbidden(all.removed)) continue;
    }
    apply_change(mesh_, change);
    changed_.resize(mesh_.links().vertex_count(), 0);
    for (const PlacedTriangle& t : all.made)
      for (const std::uint32_t v : t.vertex) changed_[v] = 1;
    return true;
  }
  return false;
}

/// Returns the changes of those triangles that no triangle before them is likely to change.
std::vector<std::optional<MeshMender::Candidates>> MeshMender::find_independent_changes(
    std::span<const std::uint32_t> bad, std::span<const std::uint8_t> doubtful) {
  const HalfEdges& links = mesh_.links();
  std::vector<std::size_t> first;
  changed_.assign(links.vertex_count(), 0);
  for (std::size_t n = 0; n < bad.size(); ++n) {
    const std::uint32_t t = bad[n];
    if (!links.is_alive(3 * t) || (!doubtful[t] && mesh_.quality().of(t) >= Tuning::good_quality)) continue;
    if (!doubtful[t] && !has_changed_around(t)) first.push_back(n);
    for (const std::uint32_t v : links.corners(t))
      links.for_each_leaving(v, [&](std::uint32_t half) { changed_[links.to(half)] = 1; });
  }
  std::vector<std::optional<Candidates>> found(bad.size());
  tbb::parallel_for(std::size_t{0}, first.size(),
                    [&](std::size_t n) { found[first[n]] = better_changes(bad[first[n]]); });
  return found;
}

/// True if this round has changed anything that the changes of a triangle depend on.
bool MeshMender::has_changed_around(std::uint32_t triangle) const {
  const auto corners = mesh_.links().corners(triangle);
  return std::ranges::any_of(corners, [&](std::uint32_t v) {
    return changed_[v] ||
           !mesh_.links().all_leaving(v, [&](std::uint32_t half) { return changed_[mesh_.links().to(half)] == 0; });
  });
}

void MeshMender::insert_points(std::span<const PointAtTriangle> points) {
  const HalfEdges& links = mesh_.links();
  std::vector<std::uint32_t> triangles;
  for (const PointAtTriangle& point : points) triangles.push_back(point.triangle);
  mesh_.guard().guard_around(triangles);
  for (const auto& [triangle, at] : points) {
    if (at.face == kNone || !links.is_alive(3 * triangle)) continue;
    std::optional<MeshChange> best;
    double score = 0.0;
    FaultCache faults(mesh_, allowed_);
    const auto consider = [&](const MeshChange& change) {
      const double now = score_after(change, false);
      if (best && now <= score) return;
      if (fault_reduction(exchange_by(mesh_, change), faults) == kWorse) return;
      best = change;
      score = now;
    };
    consider({Kind::poke, triangle, at});
    for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
      if (links.crease(half) == kNone) consider({Kind::split, half, at});
      if (const std::uint32_t v = links.from(half); !mesh_.vertex(v).on_crease()) consider({Kind::move, v, at});
    }
    if (!best) continue;
    apply_change(mesh_, *best);
    mesh_.vertex(best->kind == Kind::move ? best->where : links.vertex_count() - 1).pinned = true;
  }
  mesh_.guard().release();
}

void MeshMender::mend(std::span<const std::uint32_t> triangles) {
  std::vector<std::uint8_t> doubtful(mesh_.links().triangle_count(), 0);
  for (const std::uint32_t t : triangles) doubtful[t] = 1;
  std::vector<std::uint32_t> bad;
  mesh_.quality().compute_all();
  for (std::uint32_t t = 0; t < doubtful.size(); ++t)
    if (doubtful[t] || mesh_.quality().of(t) < Tuning::good_quality) bad.push_back(t);
  mend(std::move(bad), std::move(doubtful));
}

void MeshMender::mend_only(std::span<const std::uint32_t> triangles) {
  std::vector<std::uint8_t> doubtful(mesh_.links().triangle_count(), 0);
  for (const std::uint32_t t : triangles) doubtful[t] = 1;
  mend({triangles.begin(), triangles.end()}, std::move(doubtful));
}

/// Mends bad triangles in rounds. Doubtful triangles, and those that replace them, may cross others or be forbidden.
/// The changes of other triangles that are far apart are found first, on all cores, and found again if the round has
/// changed something there.
void MeshMender::mend(std::vector<std::uint32_t> bad, std::vector<std::uint8_t> doubtful) {
  const HalfEdges& links = mesh_.links();
  const TriangleQuality& qualities = mesh_.quality();
  mesh_.guard().guard_around(bad);
  for (int round = 0; round < Tuning::mending_rounds && !bad.empty(); ++round) {
    std::vector<std::uint32_t> next;
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    std::vector<std::optional<Candidates>> found = find_independent_changes(bad, doubtful);
    changed_.assign(links.vertex_count(), 0);
    for (std::size_t n = 0; n < bad.size(); ++n) {
      const std::uint32_t t = bad[n];
      if (mesh_.guard().work() > most_work_) return mesh_.guard().release();
      if (!links.is_alive(3 * t)) continue;
      const bool is_bad = doubtful[t] && is_faulty(t);
      if (!is_bad && qualities.of(t) >= Tuning::good_quality) continue;
      if (is_bad)
        found[n] = repairing_changes(t);
      else if (!found[n] || has_changed_around(t))
        found[n] = better_changes(t);
      if (!apply_first(*std::exchange(found[n], {}))) continue;
      doubtful.resize(links.triangle_count(), 0);
      if (!links.is_alive(3 * t)) continue;
      for (const std::uint32_t v : links.corners(t))
        links.for_each_leaving(v, [&](std::uint32_t half) {
          next.push_back(half / 3);
          if (is_bad) doubtful[half / 3] = 1;
        });
    }
    bad = std::move(next);
  }
  mesh_.guard().release();
}

}  // namespace meniscus
