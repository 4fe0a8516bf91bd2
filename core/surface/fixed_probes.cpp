// SPDX-License-Identifier: BSD-3-Clause
// Places fixed probes and toroidal patches: sorts arc ends by atoms, solves for positions, merges n-fold contacts.
#include "core/surface/fixed_probes.h"

#include <iterator>
#include <map>
#include <numbers>
#include <tuple>

#include <tbb/blocked_range.h>

#include "core/math/double_geometry.h"
#include "core/math/quad_geometry.h"
#include "core/math/union_find.h"
#include "core/surface/parallel_tables.h"

namespace meniscus {
namespace {

constexpr double kLittle = 0.01;  // radians

// One end of an exposed arc as the fixed probe at that end: its atoms a < b < c and the side of their plane.
struct ArcEnd {
  std::uint32_t b;
  std::uint32_t c;
  std::uint32_t arc_and_end;  // arc * 2 + (0 begin, 1 end)
  std::uint32_t side;         // 1: the probe is on the side of cross(b - a, c - a)
};

struct Triple {
  std::array<std::uint32_t, 3> atom;
  std::uint32_t side;
  std::array<std::uint32_t, 3> arc_and_end;
};

class Placement {
 public:
  Placement(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs)
      : atoms_(atoms), probe_radius_(probe_radius), arcs_(rs.arcs), numbers_(rs.numbers) {}

  RollingParts run() {
    collect_triples();
    if (!parts_.open_atoms.empty()) return std::move(parts_);
    place_triples();
    merge_coincident();
    place_toroidal();
    list_sides();
    return std::move(parts_);
  }

 private:
  // The triples that make up one probe: nearly always a single one.
  struct Members {
    std::uint32_t first;
    std::vector<std::uint32_t> more = {};
  };

  double extended(std::uint32_t atom) const { return atoms_[atom].radius + probe_radius_; }
  double weight(std::uint32_t atom) const { return decision_weight(extended(atom), number_of(numbers_, atom)); }

  // Buckets arc ends by their smallest atom, then sorts the small buckets, which is cheaper than one large sort.
  // Threads fill a bucket in any order, but no two ends are equal, so the sorted order is unique.
  void collect_triples() {
    std::vector<std::uint32_t> first(atoms_.size() + 1, 0);
    const auto for_each_end = [&](const auto& visit) {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, arcs_.size(), 1024), [&](const auto& range) {
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          const RsArc& arc = arcs_[n];
          if (arc.begin_by == kNone) continue;
          visit(n, arc.begin_by, 0u);
          visit(n, arc.end_by, 1u);
        }
      });
    };
    const auto take = [](std::uint32_t& number) {
      return std::atomic_ref<std::uint32_t>(number).fetch_add(1, std::memory_order_relaxed);
    };
    for_each_end([&](std::size_t n, std::uint32_t by, std::uint32_t) { take(first[std::min(arcs_[n].i, by) + 1]); });
    for (std::size_t a = 1; a < first.size(); ++a) first[a] += first[a - 1];
    std::vector<ArcEnd> ends(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for_each_end([&](std::size_t n, std::uint32_t by, std::uint32_t end) {
      const auto [a, b, c, side] = geometry::triple_at(arcs_[n].i, arcs_[n].j, by, end != 0);
      ends[take(next[a])] = {b, c, static_cast<std::uint32_t>(n) * 2 + end, side};
    });
    // Calls visit(first, past) for the arc ends of each triple with smallest atom `a`.
    const auto for_each_triple = [&](std::size_t a, const auto& visit) {
      const auto end = ends.begin() + first[a + 1];
      for (auto e = ends.begin() + first[a]; e != end;) {
        auto past = e;
        while (past != end && past->b == e->b && past->c == e->c && past->side == e->side) ++past;
        visit(e, past);
        e = past;
      }
    };
    const RowNumbers<std::uint32_t> numbers(atoms_.size(), 0, [&](std::size_t a) {
      std::sort(ends.begin() + first[a], ends.begin() + first[a + 1], [](const ArcEnd& x, const ArcEnd& y) {
        return std::tie(x.b, x.c, x.side, x.arc_and_end) < std::tie(y.b, y.c, y.side, y.arc_and_end);
      });
      std::uint32_t count = 0;
      for_each_triple(a, [&](auto e, auto past) { count += past - e == 3 ? 1 : 0; });
      return count;
    });
    triples_.resize(numbers.past());
    numbers.for_each([&](std::size_t a, std::uint32_t& t) {
      for_each_triple(a, [&](auto e, auto past) {
        if (past - e == 3)
          triples_[t++] = {{static_cast<std::uint32_t>(a), e->b, e->c},
                           e->side,
                           {e->arc_and_end, e[1].arc_and_end, e[2].arc_and_end}};
      });
    });
    if (triples_.size() * 3 == ends.size()) return;
    for (std::uint32_t a = 0; a < atoms_.size(); ++a)
      for_each_triple(a, [&](auto e, auto past) {
        if (past - e != 3) parts_.open_atoms.insert(parts_.open_atoms.end(), {a, e->b, e->c});
      });
    std::sort(parts_.open_atoms.begin(), parts_.open_atoms.end());
    parts_.open_atoms.erase(std::unique(parts_.open_atoms.begin(), parts_.open_atoms.end()), parts_.open_atoms.end());
  }

  void place_triples() {
    position_.resize(triples_.size());
    height_.resize(triples_.size());
    triple_at_.assign(arcs_.size() * 2, kNone);
    tbb::parallel_for(std::size_t{0}, triples_.size(), [&](std::size_t t) {
      for (int n = 1; n < 3 && t + kPrefetchAhead < triples_.size(); ++n)
        prefetch(atoms_, triples_[t + kPrefetchAhead].atom[n]);
      place_triple(t);
      for (std::uint32_t end : triples_[t].arc_and_end) triple_at_[end] = static_cast<std::uint32_t>(t);
    });
  }

  void place_triple(std::size_t t) {
    const auto& [a, b, c] = triples_[t].atom;
    const glm::dvec3 origin = atoms_[a].center;
    const glm::dvec3 db = atoms_[b].center - origin, dc = atoms_[c].center - origin;
    const auto [position, height] =
        geometry::fixed_probe(db, dc, extended(a), extended(b), extended(c), triples_[t].side ? 1.0 : -1.0);
    position_[t] = origin + position;
    height_[t] = height;
  }

  // True if an arc with coincident ends was empty for the decisions. Double precision decides arcs that are surely
  // short.
  bool vanishes(const RsArc& arc) const {
    const auto local = [&](std::uint32_t atom) { return atoms_[atom].center - atoms_[arc.i].center; };
    const double w = weight(arc.i);
    const geometry::Circle rough = geometry::circle_of_two_spheres(local(arc.j), w, weight(arc.j));
    const auto roughly_covered = [&](std::uint32_t k) {
      return geometry::covered_arc(
          geometry::covered_half_plane(rough, w, local(k), glm::length(local(k)), weight(k), geometry::kUnitRoundoff));
    };
    const geometry::CoveredArc before = roughly_covered(arc.begin_by), behind = roughly_covered(arc.end_by);
    const double exposed = geometry::pseudo_sweep(before.end, behind.begin), error = before.error + behind.error;
    if (rough.radius_squared > 1e-12 * w && exposed > error && exposed < 1 - error) return true;
    namespace q = quad_geometry;
    const auto quad = [](const glm::dvec3& d) { return q::real3(d.x, d.y, d.z); };
    const q::Circle circle = q::circle_of_two_spheres(quad(local(arc.j)), w, weight(arc.j));
    const auto covered = [&](std::uint32_t k) { return q::covered_by(circle, w, quad(local(k)), weight(k)); };
    return q::arc_vanishes(covered(arc.begin_by), covered(arc.end_by));
  }

  bool coincide(std::uint32_t s, std::uint32_t t) const {
    const glm::dvec3 d = position_[s] - position_[t];
    if (geometry::are_coincident(d, height_[s], height_[t])) return true;
    if (!geometry::may_be_coincident(d, height_[s], height_[t])) return false;
    const auto [flat, sharp] = geometry::is_flat(height_[s]) ? std::pair(s, t) : std::pair(t, s);
    return std::ranges::all_of(triples_[flat].atom, [&, at = position_[sharp]](std::uint32_t a) {
      return geometry::touches_atom(at - atoms_[a].center, extended(a));
    });
  }

  void merge_coincident() {
    vanished_.assign(arcs_.size(), false);
    UnionFind clusters(triples_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, arcs_.size(), 256), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n)
        vanished_[n] =
            arcs_[n].begin_by != kNone && coincide(triple_at_[n * 2], triple_at_[n * 2 + 1]) && vanishes(arcs_[n]);
    });
    const bool any = std::ranges::find(vanished_, 1) != vanished_.end();
    for (std::uint32_t n = 0; n < arcs_.size() && any; ++n)
      if (vanished_[n]) clusters.unite(triple_at_[n * 2], triple_at_[n * 2 + 1]);
    toroidal_of_arc_.assign(arcs_.size(), kNone);
    if (any) split_cavities(clusters);
    probe_of_triple_.resize(triples_.size());
    members_.clear();
    members_.reserve(triples_.size());
    for (std::uint32_t t = 0; t < triples_.size(); ++t) {
      const std::uint32_t root = any ? clusters.find(t) : t;
      if (root == t) {
        probe_of_triple_[t] = static_cast<std::uint32_t>(members_.size());
        members_.push_back({t});
      } else {
        probe_of_triple_[t] = probe_of_triple_[root];
        members_[probe_of_triple_[t]].more.push_back(t);
      }
    }
    for (const Members& cluster : members_)
      if (!cluster.more.empty()) place_members(cluster);
    if (std::ranges::any_of(height_, [](double h) { return geometry::is_flat(h); }))
      parts_.exact_within = std::max(parts_.exact_within, geometry::kLargestGrowth);
  }

  // Splits clusters that are cavities. A cluster whose remaining sides do not form one ring is a cavity too small for
  // the probe to move in: all its arcs are tiny, and none vanishes.
  void split_cavities(UnionFind& clusters) {
    std::map<std::uint32_t, std::vector<ProbeSide>> sides;
    for (std::uint32_t t = 0; t < triples_.size(); ++t)
      if (clusters.find(t) != t) sides[clusters.find(t)];
    for (std::uint32_t t = 0; t < triples_.size(); ++t)
      if (const auto cluster = sides.find(clusters.find(t)); cluster != sides.end())
        list_sides_of(t, std::back_inserter(cluster->second));
    for (auto cluster = sides.begin(); cluster != sides.end();)
      cluster = chain(cluster->second) ? sides.erase(cluster) : std::next(cluster);
    if (sides.empty()) return;
    UnionFind kept(triples_.size());
    for (std::uint32_t n = 0; n < arcs_.size(); ++n) {
      if (!vanished_[n]) continue;
      vanished_[n] = !sides.contains(clusters.find(triple_at_[n * 2]));
      if (vanished_[n]) kept.unite(triple_at_[n * 2], triple_at_[n * 2 + 1]);
    }
    clusters = std::move(kept);
  }

  // Places all members of a merged probe at the position of the member that is highest over its atoms, because that
  // position is the most accurate.
  void place_members(const Members& cluster) {
    std::uint32_t sharpest = cluster.first;
    for (const std::uint32_t t : cluster.more)
      if (height_[t] > height_[sharpest]) sharpest = t;
    const glm::dvec3 place = position_[sharpest];
    const auto move = [&](std::uint32_t t) {
      position_[t] = place;
      for (const std::uint32_t a : triples_[t].atom)
        parts_.exact_within =
            std::max(parts_.exact_within, std::abs(glm::distance(place, atoms_[a].center) - extended(a)));
    };
    move(cluster.first);
    for (const std::uint32_t t : cluster.more) move(t);
  }

  void place_toroidal() {
    std::uint32_t count = 0;
    for (std::uint32_t n = 0; n < arcs_.size(); ++n)
      if (!vanished_[n]) toroidal_of_arc_[n] = count++;
    resize_large(parts_.toroidal, count);
    std::vector<char> contradicted(arcs_.size(), 0);
    tbb::parallel_for(std::size_t{0}, arcs_.size(), [&](std::size_t n) {
      prefetch_ends(n + kPrefetchAhead);
      if (vanished_[n]) return;
      const ToroidalPatch& patch = parts_.toroidal[toroidal_of_arc_[n]] = toroidal_patch(n);
      contradicted[n] = contradicts(arcs_[n], patch);
    });
    for (std::uint32_t n = 0; n < arcs_.size(); ++n)
      if (contradicted[n]) parts_.open_atoms.insert(parts_.open_atoms.end(), {arcs_[n].i, arcs_[n].j});
  }

  // True if an arc was almost empty for the decisions and is almost a whole circle in the positions, or the reverse:
  // then the probes at its ends are in the wrong order, which no later stage would notice.
  bool contradicts(const RsArc& arc, const ToroidalPatch& patch) const {
    const bool little = patch.sweep<kLittle, much = patch.sweep> 2 * std::numbers::pi - kLittle;
    return !patch.free() && (little || much) && little != vanishes(arc);
  }

  // Prefetches what toroidal_patch() will read of a later arc.
  [[gnu::always_inline]] void prefetch_ends(std::size_t n) const {
    if (n >= arcs_.size()) return;
    prefetch(atoms_, arcs_[n].j);
    for (const std::size_t end : {2 * n, 2 * n + 1}) {
      prefetch(probe_of_triple_, triple_at_[end]);
      prefetch(position_, triple_at_[end]);
    }
  }

  ToroidalPatch toroidal_patch(std::size_t n) const {
    const RsArc& arc = arcs_[n];
    const glm::dvec3 origin = atoms_[arc.i].center;
    const double ri = extended(arc.i), rj = extended(arc.j);
    const geometry::RollingArc whole = geometry::whole_turn(origin, atoms_[arc.j].center - origin, ri, rj,
                                                            weight(arc.i), weight(arc.j), probe_radius_);
    ToroidalPatch patch;
    patch.atom = {arc.i, arc.j};
    patch.center = whole.center;
    patch.axis = whole.axis;
    patch.radius = whole.radius;
    patch.start = whole.start;
    patch.sweep = 2 * std::numbers::pi;
    if (arc.begin_by == kNone) return patch;
    const std::uint32_t begin = triple_at_[n * 2], end = triple_at_[n * 2 + 1];
    patch.probe = {probe_of_triple_[begin], probe_of_triple_[end]};
    const auto position = [&](std::uint32_t probe) { return position_[members_[probe].first]; };
    const geometry::RollingArc part = geometry::part_between(whole, position(patch.probe[0]), position(patch.probe[1]));
    patch.start = part.start;
    patch.sweep = std::atan2(part.sine, part.cosine);
    if (patch.sweep <= 0) patch.sweep += 2 * std::numbers::pi;
    if (geometry::ends_coincide(position_[begin], position_[end])) {
      const bool tiny = vanishes(arc);
      if (!tiny && patch.sweep < std::numbers::pi) patch.sweep = 2 * std::numbers::pi;
      if (tiny && patch.sweep > std::numbers::pi) patch.sweep = 0;
    }
    return patch;
  }

  void list_sides() {
    FixedProbes& probes = parts_.probes;
    probes.position.resize(members_.size());
    probes.height.resize(members_.size());
    probes.first_side.resize(members_.size() + 1);
    const auto side_count = [&](std::size_t s) {
      std::uint32_t count = sides_left(members_[s].first);
      for (const std::uint32_t t : members_[s].more) count += sides_left(t);
      return count;
    };
    const RowNumbers<std::uint32_t> numbers(members_.size(), 0, side_count);
    probes.first_side.back() = numbers.past();
    resize_large(probes.sides, numbers.past());
    std::vector<char> open(members_.size(), 0);
    numbers.for_each([&](std::size_t s, std::uint32_t& next) {
      probes.first_side[s] = next;
      probes.position[s] = position_[members_[s].first];
      probes.height[s] = height_[members_[s].first];
      const auto begin = probes.sides.begin() + next;
      auto past = list_sides_of(members_[s].first, begin);
      for (const std::uint32_t t : members_[s].more) {
        past = list_sides_of(t, past);
        probes.height[s] = std::min(probes.height[s], height_[t]);
      }
      open[s] = !chain({begin, past});
      next += static_cast<std::uint32_t>(past - begin);
    });
    for (std::uint32_t s = 0; s < members_.size(); ++s)
      if (open[s])
        for (std::uint32_t a : triples_[members_[s].first].atom) parts_.open_atoms.push_back(a);
    if (!numbers_.empty()) number_probes();
  }

  // Numbers probes by their atoms, so that the number of a probe does not depend on other probes.
  void number_probes() {
    FixedProbes& probes = parts_.probes;
    probes.numbers.resize(probes.count());
    for (std::uint32_t s = 0; s < probes.count(); ++s) {
      std::uint32_t number = 0;
      for (const ProbeSide& side : probes.sides_of(s)) number = number * 0x9e3779b1u + numbers_[side.from] + 1;
      probes.numbers[s] = number;
    }
  }

  // Returns the number of sides of a triple that belong to arcs that have not vanished.
  std::uint32_t sides_left(std::uint32_t triple) const {
    std::uint32_t count = 0;
    for (const std::uint32_t end : triples_[triple].arc_and_end) count += vanished_[end / 2] ? 0 : 1;
    return count;
  }

  // Writes the sides of a triple; returns the iterator past them.
  template <typename Out>
  Out list_sides_of(std::uint32_t triple, Out side) const {
    for (const std::uint32_t end : triples_[triple].arc_and_end) {
      if (vanished_[end / 2]) continue;
      const RsArc& arc = arcs_[end / 2];
      const bool at_end = end & 1;
      *side++ = {at_end ? arc.j : arc.i, at_end ? arc.i : arc.j, toroidal_of_arc_[end / 2], at_end};
    }
    return side;
  }

  // Orders sides head to tail, starting at the smallest atom. False if they do not form one ring.
  static bool chain(std::span<ProbeSide> sides) {
    if (sides.size() < 3) return false;
    auto first = std::min_element(sides.begin(), sides.end(), [](auto& x, auto& y) { return x.from < y.from; });
    std::iter_swap(sides.begin(), first);
    for (std::size_t n = 1; n < sides.size(); ++n) {
      auto next = std::find_if(sides.begin() + static_cast<std::ptrdiff_t>(n), sides.end(),
                               [&](auto& x) { return x.from == sides[n - 1].to; });
      if (next == sides.end()) return false;
      std::iter_swap(sides.begin() + static_cast<std::ptrdiff_t>(n), next);
    }
    return sides.back().to == sides.front().from;
  }

  std::span<const Ball> atoms_;
  double probe_radius_;
  const std::vector<RsArc>& arcs_;
  AtomNumbers numbers_;
  std::vector<Triple> triples_;
  std::vector<glm::dvec3> position_;      // per triple
  std::vector<double> height_;            // per triple
  std::vector<std::uint32_t> triple_at_;  // arc * 2 + end -> triple
  std::vector<char> vanished_;            // per arc
  std::vector<std::uint32_t> probe_of_triple_;
  std::vector<Members> members_;  // per probe
  std::vector<std::uint32_t> toroidal_of_arc_;
  RollingParts parts_;
};

}  // namespace

RollingParts place_rolling_parts(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs) {
  return Placement(atoms, probe_radius, rs).run();
}

}  // namespace meniscus
