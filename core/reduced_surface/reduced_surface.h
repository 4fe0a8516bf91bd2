// SPDX-License-Identifier: BSD-3-Clause
// The reduced surface as pure combinatorics: the exposed arcs of circles, the atoms that end them, and whole spheres;
// and its exhaustive enumeration on the CPU.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/constants.h"

namespace meniscus {

struct Ball;

/// The numbers by which radii grow (decision_weights()), one per atom, ascending. Empty: each atom's index. Atoms taken
/// out of a larger set keep their numbers from there, so that decisions about them stay the same.
using AtomNumbers = std::span<const std::uint32_t>;

inline std::uint32_t number_of(AtomNumbers numbers, std::uint32_t atom) {
  return numbers.empty() ? atom : numbers[atom];
}

/// An exposed arc of the SAS circle of atoms i < j (an RS edge), counter-clockwise about the axis from i to j.
/// It begins where it leaves the SAS ball of atom `begin_by` and ends where it enters that of `end_by`;
/// both are kNone for a free edge (a whole circle).
struct RsArc {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::uint32_t begin_by = kNone;
  std::uint32_t end_by = kNone;
  auto operator<=>(const RsArc&) const = default;
};

/// All exposed arcs, sorted, and the atoms without arcs that are wholly exposed. Every method that computes the arcs
/// (exhaustive enumeration, rolling probe, GPU) must give the same ones; find_whole_spheres() finds the atoms by them.
struct ReducedSurface {
  std::vector<RsArc> arcs;
  std::vector<std::uint32_t> lone_atoms;  ///< SAS spheres that meet no other and lie in none, sorted
  std::vector<std::uint32_t> lost_atoms;  ///< atoms with missing arcs, sorted; none unless there is a fault
  double exact_within = 0.0;              ///< largest change of radii, Å, for which all decisions are right
  std::vector<std::uint32_t> numbers;     ///< AtomNumbers of atoms taken out of a larger set
  bool operator==(const ReducedSurface&) const = default;
};

/// Statistics of how the circles of one frame were decided.
struct CircleStats {
  std::size_t pairs = 0;                 ///< overlapping pairs of SAS balls, each one circle
  std::size_t decided_in_double = 0;     ///< circles that single precision left in doubt; none on the CPU
  std::size_t decided_in_quadruple = 0;  ///< circles that double left in doubt, decided on the host
  std::size_t ties = 0;                  ///< circles that the growth of decision weights decides
};

/// Returns the squared SAS radii in which every sign decision is taken: (r_i + p + g_i)^2, with g_i between 1e-9 and
/// 1.5e-9 Å, different for each number. Touching thereby counts as overlapping, in any orientation, and n-fold contacts
/// become consistent threefold ones. The perturbation is the same for all predicates, so no two circles can disagree.
/// Positions, areas and volumes are computed from the unchanged radii.
std::vector<double> decision_weights(std::span<const Ball> atoms, double probe_radius, AtomNumbers numbers = {});

/// Returns the golden-ratio hash of an index in [0, 1): neighbouring indices get distant values.
double scattered(std::size_t index);

/// Returns the decision weight of one ball of (extended) radius R with the given index.
double decision_weight(double radius, std::size_t index);

/// Returns the weight of a ball with a radius as much below the given one as that of this decision weight is above it.
double shrunk_weight(double decision_weight, std::size_t index);

/// Returns the relative error to assume for numbers so that every circle which growth may decide is in doubt: bounds on
/// rounding allow for squared radii that are off by three units. 0 where a radius is so small that too many circles
/// would be in doubt.
double growth_as_roundoff(std::span<const double> decision_weights);

/// Computes ReducedSurface::exact_within. roundoff: growth_as_roundoff(); protruding: from swallowed_atoms().
double decided_within(double roundoff, std::size_t ties, double protruding);

/// Returns the decision weight of a fixed probe where probes cut each other: grown only by 1e-12 to 1.5e-12 Å. Two
/// probes may be as near as 1e-6 Å, and growth moves the plane between them by its ratio to their distance, while the
/// axes of spindle circles, which lie in that plane, do not move. Copies about a symmetry axis have such probes, and
/// their exact ties remain broken: quadruple precision distinguishes weights that differ by far less.
double probe_decision_weight(double probe_radius, std::size_t index);

/// Finds the atoms whose SAS ball lies, up to 1e-6 Å, in the SAS ball of an atom that is not swallowed itself; of equal
/// balls the lower index stays. They have no patch and block nothing more. protruding: receives the largest distance,
/// Å, by which a swallowed ball protrudes.
std::vector<bool> swallowed_atoms(std::span<const Ball> atoms, double* protruding = nullptr);

/// Finds swallowed_atoms() of one frame after another. The pairs in which one ball could swallow another are found
/// once, with an allowance for the motion of all atoms. As long as no atom has moved farther, and radii are the same,
/// only those pairs are tested; if one swallows another, or if atoms move farther or crowd, all pairs are found again.
class SwallowedAtoms {
 public:
  std::vector<bool> of(std::span<const Ball> atoms);

 private:
  bool still_near(std::span<const Ball> atoms) const;
  void find_pairs(std::span<const Ball> atoms);
  bool any_holds(std::span<const Ball> atoms) const;

  std::vector<Ball> found_at_;  ///< the atoms at the last search for pairs_, successful or not
  bool has_pairs_ = false;
  bool crowded_ = false;                             ///< true if there are too many pairs to list
  std::vector<std::array<std::uint32_t, 2>> pairs_;  ///< pairs with the lower index first
};

/// Computes lone_atoms and lost_atoms of a reduced surface. Its arcs must have been found already.
///
/// A sphere without an exposed arc is exposed as a whole or not at all, so each of its points decides (theorem 4). Two
/// opposite points are tested against the balls alone, by the decision weights, independently of the method that found
/// the arcs. Exposed spheres that meet no other are lone. If the points of a sphere disagree, or if it is exposed and
/// meets another, arcs are missing: its atom is lost.
///
/// atoms: van der Waals balls in Å; weights, swallowed: decision_weights() and swallowed_atoms() of these.
void find_whole_spheres(std::span<const Ball> atoms, std::span<const double> weights,
                        const std::vector<bool>& swallowed, ReducedSurface& rs);

/// Enumerates the reduced surface. atoms in Å, probe_radius >= 0 in Å; numbers: for atoms taken out of a larger set.
/// Runs on all cores that TBB may use; the result does not depend on their number.
ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, CircleStats* stats = nullptr,
                                         AtomNumbers numbers = {});

}  // namespace meniscus
