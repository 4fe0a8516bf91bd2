// SPDX-License-Identifier: BSD-3-Clause
// Enumerates all RS edges, atom by atom in parallel (contour build-up: Totrov & Abagyan 1996).

#include <numeric>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/reduced_surface/contour/blockers.h"
#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/cpu/neighbor_search.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {
namespace {

// The number of atoms in a group. Atoms are named by their places in NeighborSearch, and pass the stages in groups.
constexpr std::size_t kGroup = 64;
// The number of open circles from which it pays to search for circles within the caps of others: on a line of N atoms
// all N² / 2 are open. Molecules have fewer.
constexpr std::uint32_t kCrowd = 192;

// The intermediate results of the atoms of one group.
struct Group {
  std::vector<std::uint32_t>
      neighbors;  // neighbours of atom after atom, neighbours with open circles first; none for buried atoms
  std::vector<std::uint32_t> first;     // per atom, into neighbors; one past the last closes the list
  std::vector<std::uint32_t> open;      // per atom: the number of its open circles
  std::vector<std::uint8_t> uncovered;  // atom after atom: directions near which the atom may be exposed (blockers.h)
  std::vector<std::uint32_t> first_uncovered;  // per atom; one past the last closes the list
  std::vector<RsArc> arcs;                     // arcs of atom after atom, sorted within each
  std::size_t pairs = 0;
};

// Returns a pseudo-angle inside an arc.
double middle_of(const ExposedArc& arc) {
  const double middle = arc.begin + 0.5 * geometry::pseudo_sweep(arc.begin, arc.end);
  return middle < 4 ? middle : middle - 4;
}

// The reusable lists of one worker.
struct Worker {
  explicit Worker(double roundoff) : contour(roundoff) {}

  NeighborSearch::Surroundings surroundings;
  Blockers blockers;
  Blockers open_blockers;
  Blockers nearest_first;  // blockers sorted around the atom nearest_of
  std::size_t nearest_of = kNone;
  SphereCover cover;
  NestedCaps caps;
  Contour contour;
  TieWatch ties;
};

class Enumeration {
 public:
  Enumeration(std::span<const Ball> atoms, double probe_radius, std::span<const double> weights,
              const std::vector<bool>& swallowed, double roundoff, AtomNumbers numbers)
      : atom_count_(atoms.size()),
        numbers_(numbers),
        search_(atoms, probe_radius, weights, swallowed),
        groups_((search_.size() + kGroup - 1) / kGroup),
        workers_([roundoff] { return Worker(std::max(roundoff, geometry::kUnitRoundoff)); }) {}

  std::vector<RsArc> run(CircleStats& stats) {
    // Nearly half of all atoms are buried, which is found quickly; their circles need no test.
    for_each_group([&](std::size_t group, Worker& worker) { list_neighbors(group, worker); });
    for_each_group([&](std::size_t group, Worker& worker) { list_arcs(group, worker); });
    for (const Group& group : groups_) stats.pairs += group.pairs / 2;
    for (const Worker& worker : workers_) {
      stats.decided_in_quadruple += worker.contour.doubtful_count();
      stats.ties += worker.ties.ties();
    }
    return sorted_arcs();
  }

 private:
  template <typename Visit>
  void for_each_group(const Visit& visit) {
    tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t group) { visit(group, workers_.local()); });
  }

  std::size_t past_last(std::size_t group) const { return std::min((group + 1) * kGroup, search_.size()); }

  std::span<const std::uint32_t> neighbors_of(std::size_t place) const {
    const Group& group = groups_[place / kGroup];
    const std::uint32_t* first = group.first.data() + place % kGroup;
    return {group.neighbors.data() + first[0], group.neighbors.data() + first[1]};
  }

  // Returns the neighbours with which an atom has open circles: circles that are not surely covered.
  std::span<const std::uint32_t> open_neighbors_of(std::size_t place) const {
    return neighbors_of(place).first(groups_[place / kGroup].open[place % kGroup]);
  }

  std::span<const std::uint8_t> uncovered_of(std::size_t place) const {
    const Group& group = groups_[place / kGroup];
    const std::uint32_t* first = group.first_uncovered.data() + place % kGroup;
    return {group.uncovered.data() + first[0], group.uncovered.data() + first[1]};
  }

  void list_neighbors(std::size_t number, Worker& w) {
    Group& group = groups_[number];
    group.first.assign(1, 0);
    group.first_uncovered.assign(1, 0);
    for (std::size_t place = number * kGroup; place < past_last(number); ++place) {
      const std::size_t known = group.neighbors.size();
      search_.append_neighbors(place, w.surroundings, group.neighbors);
      const std::size_t count = group.neighbors.size() - known;
      group.pairs += count;
      if (test_sphere(place, known, group.neighbors, w)) {
        const std::span<const std::uint8_t> uncovered = w.cover.uncovered();
        group.uncovered.insert(group.uncovered.end(), uncovered.begin(), uncovered.end());
      } else {
        group.neighbors.resize(known);
      }
      group.first_uncovered.push_back(static_cast<std::uint32_t>(group.uncovered.size()));
      group.open.push_back(open_first(std::span(group.neighbors).subspan(known), w.cover));
      group.first.push_back(static_cast<std::uint32_t>(group.neighbors.size()));
    }
    group.neighbors.shrink_to_fit();
    group.uncovered.shrink_to_fit();
  }

  // Tests the sphere of an atom, whose neighbours are the last ones of the list from `first` on. Where they crowd,
  // neighbours that cover nothing that others do not cover are removed.
  bool test_sphere(std::size_t place, std::size_t first, std::vector<std::uint32_t>& neighbors, Worker& w) {
    const std::size_t count = neighbors.size() - first;
    search_.list_blockers(place, std::span(neighbors).subspan(first), w.blockers);
    if (!w.cover.test(w.blockers)) return false;
    if (count < kCrowd) return true;
    std::uint32_t open = 0;
    for (std::size_t n = 0; n < count; ++n) open += w.cover.circle_may_be_exposed(n) ? 1 : 0;
    if (open < kCrowd) return true;
    const std::vector<std::uint8_t>& nested = w.caps.find(w.blockers);
    std::size_t kept = first;
    for (std::size_t n = 0; n < count; ++n)
      if (!nested[n]) neighbors[kept++] = neighbors[first + n];
    neighbors.resize(kept);
    search_.list_blockers(place, std::span(neighbors).subspan(first), w.blockers);
    return w.cover.test(w.blockers);
  }

  // Moves the neighbours with open circles to the front; returns their number. Each is exchanged with the first of the
  // others in any case, because a branch would be mispredicted.
  static std::uint32_t open_first(std::span<std::uint32_t> neighbors, const SphereCover& cover) {
    std::uint32_t open = 0;
    for (std::size_t n = 0; n < neighbors.size(); ++n) {
      std::swap(neighbors[open], neighbors[n]);
      open += cover.circle_may_be_exposed(n) ? 1 : 0;
    }
    return open;
  }

  void list_arcs(std::size_t number, Worker& w) {
    Group& group = groups_[number];
    for (std::size_t place = number * kGroup; place < past_last(number); ++place) {
      if (open_neighbors_of(place).empty()) continue;
      const std::size_t known = group.arcs.size();
      list_arcs_of(place, neighbors_of(place), w, group.arcs);
      std::sort(group.arcs.begin() + static_cast<std::ptrdiff_t>(known), group.arcs.end());
    }
  }

  // Lists the arcs on the circles of an atom with atoms of higher index.
  void list_arcs_of(std::size_t place, std::span<const std::uint32_t> neighbors, Worker& w, std::vector<RsArc>& arcs) {
    const std::uint32_t i = search_.atom(place);
    const std::size_t open = open_neighbors_of(place).size();
    search_.list_blockers(place, neighbors.first(open), w.open_blockers);
    bool all_listed = false;
    for (std::size_t n = 0; n < open; ++n) {
      const std::uint32_t j = search_.atom(neighbors[n]);
      if (j < i || !is_open(neighbors[n], place)) continue;
      const Blockers::Ball b = w.open_blockers[n];
      // Only the part near uncovered directions is exposed.
      const bool by_open = w.contour.expose_at_once(b.center, b.weight, w.open_blockers, n);
      if (!by_open) {
        if (!all_listed) search_.list_blockers(place, neighbors, w.blockers);
        all_listed = true;
        if (!w.contour.expose_at_once(b.center, b.weight, w.blockers, n)) expose_nearest_first(place, b, neighbors, w);
      }
      const auto is_exposed = [&](double pseudo) {
        return !by_open ||
               SphereCover::is_near(w.contour.point(pseudo) / std::sqrt(search_.weight(place)), uncovered_of(place));
      };
      if (w.contour.whole() && is_exposed(0)) arcs.push_back({i, j, kNone, kNone});
      for (const ExposedArc& arc : w.contour.arcs())
        if (is_exposed(middle_of(arc))) arcs.push_back({i, j, search_.atom(arc.begin_by), search_.atom(arc.end_by)});
    }
  }

  bool is_open(std::size_t place, std::size_t neighbor) const {
    const auto open = open_neighbors_of(place);
    return std::find(open.begin(), open.end(), neighbor) != open.end();
  }

  // Decides a circle that double leaves in doubt: nearest balls first, in an order independent of the grid.
  void expose_nearest_first(std::size_t place, const Blockers::Ball& b, std::span<const std::uint32_t> neighbors,
                            Worker& w) const {
    if (w.nearest_of != place) {
      std::vector<std::size_t> order(neighbors.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      const auto rank = [&](std::size_t n) { return std::pair(w.blockers[n].square, search_.atom(neighbors[n])); };
      std::ranges::sort(order, {}, rank);
      std::vector<std::uint32_t> sorted;
      sorted.reserve(order.size());
      for (const std::size_t n : order) sorted.push_back(neighbors[n]);
      search_.list_blockers(place, sorted, w.nearest_first);
      w.nearest_of = place;
    }
    std::size_t skip = 0;
    while (w.nearest_first.label(skip) != b.label) ++skip;
    const std::size_t doubtful = w.contour.doubtful_count();
    w.contour.expose(b.center, b.weight, w.nearest_first, skip);
    if (w.contour.doubtful_count() > doubtful)
      w.ties.compare(w.contour, w.nearest_first, skip, number_at(place),
                     [&](std::uint32_t label) { return number_at(label); });
  }

  // Sorts arcs by atoms: the arcs of each atom are adjacent and already sorted.
  std::vector<RsArc> sorted_arcs() {
    std::vector<std::uint32_t> first(atom_count_ + 1, 0);
    for (const Group& group : groups_)
      for (const RsArc& arc : group.arcs) ++first[arc.i + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<RsArc> arcs(first.back());
    tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t number) {
      const std::vector<RsArc>& found = groups_[number].arcs;
      for (std::size_t n = 0, of_atom = 0; n < found.size(); ++n) {
        of_atom = n > 0 && found[n].i == found[n - 1].i ? of_atom + 1 : 0;
        arcs[first[found[n].i] + of_atom] = found[n];
      }
    });
    return arcs;
  }

  std::uint32_t number_at(std::size_t place) const { return number_of(numbers_, search_.atom(place)); }

  std::size_t atom_count_;
  AtomNumbers numbers_;
  NeighborSearch search_;
  std::vector<Group> groups_;
  tbb::enumerable_thread_specific<Worker> workers_;
};

}  // namespace

ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, CircleStats* stats,
                                         AtomNumbers numbers) {
  const std::vector<double> weights = decision_weights(atoms, probe_radius, numbers);
  double protruding = 0;
  const std::vector<bool> swallowed = swallowed_atoms(atoms, &protruding);
  const double roundoff = growth_as_roundoff(weights);
  CircleStats found;
  ReducedSurface rs;
  rs.numbers.assign(numbers.begin(), numbers.end());
  rs.arcs = Enumeration(atoms, probe_radius, weights, swallowed, roundoff, numbers).run(found);
  rs.exact_within = decided_within(roundoff, found.ties, protruding);
  if (stats) *stats = found;
  find_whole_spheres(atoms, weights, swallowed, rs);
  return rs;
}

}  // namespace meniscus
