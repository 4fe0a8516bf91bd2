// SPDX-License-Identifier: BSD-3-Clause
// Checks one surface against all knowledge that does not need its own combinatorics, and names disagreements.
#pragma once

#include <optional>
#include <string>

#include "core/surface/primitives.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {

/// The result of checking one input.
struct SurfaceVerdict {
  bool refused = false;   ///< OpenSurfaceError for the balls as given or turned
  bool lost = false;      ///< something of the surface is missing (completeness.h); the complaint says what
  bool tied = false;      ///< another surface when turned, within the bounds of turning.h
  std::string complaint;  ///< empty if all checks agree; else one line
  std::optional<Surface> surface;
};

/// Says whether the surface is computed once more, with turned and reordered atoms.
enum class Turned { no, too };

/// Computes the surface on the CPU and checks it: random points of every atom's SAS sphere (completeness.h), the area
/// of each re-entrant patch against its planes by sampling, areas of atoms, the same surface turned (turning.h), a
/// mesh, points of every patch and the volume against an oracle that knows only the balls (sphere_tracer.h). That
/// oracle gets the balls as decisions see them (decision_weight()), so ties are no excuse. effort: 0 leaves mesh and
/// oracle out, 1 looks for errors of a whole sphere, larger ones sample so much more.
SurfaceVerdict check_surface(const Balls& balls, double probe_radius, std::uint32_t seed, int effort = 1,
                             Turned turned = Turned::no);

}  // namespace meniscus::testing
