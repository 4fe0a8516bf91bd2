// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of a molecule: one, or one for each chain, model, class, residue or component.
#pragma once

#include <optional>
#include <vector>

#include "core/queries/surface_object.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Which closed parts of the surface are taken.
enum class Cavities {
  keep,  ///< all of them
  drop,  ///< those that the outside reaches: no cavities, and nothing that lies in one
  only   ///< the others
};

/// What becomes of the copies of an assembly.
enum class InstanceMode {
  none,     ///< they are atoms like all others, under one surface
  exact,    ///< one copy is computed; refused unless that gives the surface of the whole
  separate  ///< one copy is computed as if alone
};

/// What the surface is divided into.
struct Division {
  std::optional<Grouping> groups;  ///< each group of atoms has a surface of its own, as if it were alone
  bool components = false;         ///< each closed part is an object
  Cavities cavities = Cavities::keep;
  InstanceMode instances = InstanceMode::none;
};

/// Closed surfaces with their names and atoms, not yet coloured. A group of atoms may have none: with --cavities only.
/// Throws OpenSurfaceError, naming atoms by chain, residue and name; CapacityError, GpuError; Error when no part of the
/// surface is left.
std::vector<SurfaceObject> surface_objects(const Structure& structure, const Division& division,
                                           SurfaceComputer& computer);

/// Throws InputError, naming two atoms, where one probe can touch two copies of the structure at once: then copies of
/// one surface are not the surface of the whole.
void require_apart(const Structure& structure, double probe_radius);

/// The largest of all certificates, in Å; 0 as a rule: by how much radii were grown to tell ties apart, and for radii
/// how near the given ones the surfaces are exact.
struct RadiiChange {
  double grown_by = 0.0;
  double exact_within = 0.0;
};
RadiiChange change_of_radii(const std::vector<SurfaceObject>& objects);

}  // namespace meniscus
