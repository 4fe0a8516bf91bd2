// SPDX-License-Identifier: BSD-3-Clause
// The reduced surface as pure combinatorics: which circles have exposed arcs, and which atoms end them.
#pragma once

#include <compare>
#include <cstddef>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/constants.h"

namespace meniscus {

struct Ball;

/// The numbers by which radii grow (decision_weights()), rising, one an atom. Empty: each atom's index. Atoms taken out
/// of many keep the numbers they had there, so that what is decided about them stays the same.
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

/// All exposed arcs, sorted, and the atoms that have none but are wholly exposed. Whatever computes the arcs
/// (exhaustive enumeration, rolling probe, GPU) must give the same ones; the atoms follow from them (whole_spheres.h).
struct ReducedSurface {
  std::vector<RsArc> arcs;
  std::vector<std::uint32_t> lone_atoms;  ///< SAS spheres that meet no other and lie in none, sorted
  std::vector<std::uint32_t> lost_atoms;  ///< of which arcs must be missing, sorted; none unless there is a fault
  double exact_within = 0.0;           ///< Å by which radii may have to change at most for all decisions to be theirs
  std::vector<std::uint32_t> numbers;  ///< of atoms that are part of more: theirs in the whole, AtomNumbers
  bool operator==(const ReducedSurface&) const = default;
};

/// How the circles of one frame were decided.
struct CircleStats {
  std::size_t pairs = 0;                 ///< overlapping pairs of SAS balls, each one circle
  std::size_t decided_in_double = 0;     ///< circles that single precision left in doubt; none on the CPU
  std::size_t decided_in_quadruple = 0;  ///< circles that double left in doubt, decided on the host
  std::size_t ties = 0;                  ///< circles that the growth of decision weights decides
};

/// The squared SAS radii in which every sign decision is taken: (r_i + p + g_i)^2, with g_i between 1e-9 and 1.5e-9 Å,
/// different for each number. Touching thereby counts as overlapping, in any orientation; and n-fold contacts fall
/// apart into consistent threefold ones (a perturbation that is the same for all predicates, so no two circles can
/// disagree). Positions, areas and volumes are computed from the unchanged radii.
std::vector<double> decision_weights(std::span<const Ball> atoms, double probe_radius, AtomNumbers numbers = {});

/// Golden-ratio hash of an index to [0, 1): neighbouring indices land far apart.
double scattered(std::size_t index);

/// The decision weight of one ball of (extended) radius R with the given index.
double decision_weight(double radius, std::size_t index);

/// The weight of a ball whose radius is as much below the given one as that of this decision weight is above it.
double shrunk_weight(double decision_weight, std::size_t index);

/// By how much numbers are taken to be off, relative, so that every circle which growth may decide is in doubt: bounds
/// on rounding allow for squared radii that are off by three units. 0 where a radius is so small that too many would
/// be.
double growth_as_roundoff(std::span<const double> decision_weights);

/// ReducedSurface::exact_within. roundoff: growth_as_roundoff(); protruding: of swallowed_atoms().
double decided_within(double roundoff, std::size_t ties, double protruding);

/// The decision weight of a fixed probe where probes cut each other: grown by 1e-12 to 1.5e-12 Å only. Two probes may
/// be as near as 1e-6 Å, and growth moves the plane between them by its ratio to their distance; through it run the
/// axes of spindle circles, which do not move. Copies about a symmetry axis have such probes, and their exact ties
/// remain broken: quadruple precision distinguishes weights that differ by far less.
double probe_decision_weight(double probe_radius, std::size_t index);

/// Atoms whose SAS ball lies in that of an atom that is not swallowed itself, but for 1e-6 Å (ties: the lower index
/// wins). They have no patch and block nothing more. protruding: gets the Å by which one of them sticks out at most.
std::vector<bool> swallowed_atoms(std::span<const Ball> atoms, double* protruding = nullptr);

/// swallowed_atoms() of one frame after another: the pairs in which one ball could swallow another are found once, with
/// room for a way that all atoms may go. As long as none has gone farther, and radii are the same, only those pairs are
/// asked again; where one does swallow another, or atoms go farther from frame to frame or crowd, all is found again.
class SwallowedAtoms {
 public:
  std::vector<bool> of(std::span<const Ball> atoms);

 private:
  bool still_near(std::span<const Ball> atoms) const;
  void find_pairs(std::span<const Ball> atoms);
  bool any_holds(std::span<const Ball> atoms) const;

  std::vector<Ball> found_at_;  ///< the atoms when pairs_ was found, or was not
  bool has_pairs_ = false;
  bool crowded_ = false;                             ///< there are too many pairs to list
  std::vector<std::array<std::uint32_t, 2>> pairs_;  ///< the lower index first
};

}  // namespace meniscus
