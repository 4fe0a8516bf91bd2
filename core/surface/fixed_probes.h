// SPDX-License-Identifier: BSD-3-Clause
// Fixed probes and toroidal patches, placed in double precision from the atoms that define them.
#pragma once

#include "core/surface/primitives.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// One side of a concave patch: the end of one toroidal patch, between two neighbouring contacts.
struct ProbeSide {
  std::uint32_t from = 0;      ///< atom; the next side starts at this side's `to`
  std::uint32_t to = 0;        ///< atom
  std::uint32_t toroidal = 0;  ///< index of the patch that ends here
  bool at_end = false;         ///< false: the probe is the patch's start, from < to; true: its end, from > to
};

/// All fixed probes, sorted by their smallest atom triple; the sides of probe s are
/// sides[first_side[s]] to sides[first_side[s + 1] - 1], counter-clockwise seen from the probe.
struct FixedProbes {
  std::vector<glm::dvec3> position;
  std::vector<double> height;  ///< smallest distance from the probe to a plane through three of its contacts
  std::vector<std::uint32_t> first_side;
  std::vector<ProbeSide> sides;
  std::vector<std::uint32_t>
      numbers;  ///< the numbers by which probe_decision_weight() grows the probes; empty: their indices

  std::size_t count() const { return position.size(); }
  std::span<const ProbeSide> sides_of(std::uint32_t probe) const {
    return {sides.data() + first_side[probe], sides.data() + first_side[probe + 1]};
  }
};

/// The parts of a surface that follow from a rolling probe: its fixed positions and the tori between these.
struct RollingParts {
  FixedProbes probes;
  std::vector<ToroidalPatch> toroidal;  ///< sorted by atoms; their faces are filled in later
  std::vector<std::uint32_t>
      open_atoms;             ///< atoms of triples in which the number of arc ends is not three; empty if closed
  double exact_within = 0.0;  ///< largest change of radii, Å, for which the probes are exactly where they are placed
};

/// Places fixed probes and toroidal patches. Probes closer than 1e-6 Å that a vanishing arc connects become one probe
/// with n contacts, and that arc disappears.
RollingParts place_rolling_parts(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs);

}  // namespace meniscus
