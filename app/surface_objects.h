// SPDX-License-Identifier: BSD-3-Clause
// From the atoms of a structure to the surfaces of a molecule: one, or one a chain, model, class, residue, component.
#pragma once

#include <vector>

#include "app/compute.h"
#include "app/options/molecule_options.h"
#include "core/structure/structure.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// Closed surfaces with their names and atoms, not yet coloured. A group of atoms may have none: with --cavities only.
/// Throws OpenSurfaceError, naming atoms by chain, residue and name; CapacityError, GpuError; Error when no part of the
/// surface is left.
std::vector<SurfaceObject> surface_objects(const Structure& structure, const DivisionOptions& division,
                                           SurfaceComputer& computer);

/// By how many Å radii were grown at most to tell ties apart (core/surface/tie_ladder.h); 0 as a rule.
double largest_growth(const std::vector<SurfaceObject>& objects);

}  // namespace meniscus
