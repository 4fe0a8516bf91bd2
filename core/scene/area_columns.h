// SPDX-License-Identifier: BSD-3-Clause
// Areas of atoms and their derivatives, as columns of tables.
#pragma once

#include <string>
#include <vector>

#include "core/queries/surface_object.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"
#include "core/surface/measure.h"

namespace meniscus {

/// An area of each atom of a structure, Å².
struct AreaColumn {
  std::string name;  ///< "ses_area", "sas_area", "vdw_area"; a word of ours
  std::vector<double> values;
  double total = 0.0;  ///< of all copies of all atoms

  /// Of one copy of these atoms.
  double total_of(const AtomGroup& group) const;
};

/// The columns of area_columns without values, their totals alone, which take next to no time.
std::vector<AreaColumn> area_totals(const std::vector<SurfaceObject>& objects, SurfaceKind kind);

/// For a solvent-excluded surface "ses_area" and "sas_area", else the area of the surface that was made. An atom in
/// several objects has the sum, of one copy of each.
std::vector<AreaColumn> area_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                     SurfaceKind kind);

/// A derivative by the position of each atom of a structure.
struct GradientColumn {
  std::string name;  ///< "ses_area", "ses_volume", "sas_area", "sas_volume", "vdw_area", "vdw_volume"; a word of ours
  Gradient values;   ///< Å²/Å, or Å³/Å
};

/// Area and volume of the surface that was made, summed over objects; of a solvent-excluded one those of the
/// accessible one, too. Objects must be surfaces of whole groups of atoms. Throws InputError, naming the
/// atoms, where a probe touches more than three.
std::vector<GradientColumn> gradient_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                             SurfaceKind kind);

}  // namespace meniscus
