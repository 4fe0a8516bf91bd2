// SPDX-License-Identifier: BSD-3-Clause
// Areas of atoms and their derivatives, as columns of tables.
#pragma once

#include "core/queries/surface_object.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"
#include "core/surface/measure.h"

namespace meniscus {

/// An area of each atom of a structure, Å².
struct AreaColumn {
  std::string name;  ///< "ses_area", "sas_area" or "vdw_area"; a constant text
  std::vector<double> values;
  double total = 0.0;          ///< Å², over all copies of all atoms
  std::vector<double> sums{};  ///< Å², over one copy of each group of area_sums(); empty in other columns

  /// Returns the sum over one copy of these atoms, Å².
  double total_of(const AtomGroup& group) const;
};

/// Returns the columns of area_columns() with their totals but without values, which takes very little time.
std::vector<AreaColumn> area_totals(const std::vector<SurfaceObject>& objects, SurfaceKind kind);

/// Returns the columns of area_columns() with sums over groups of atoms instead of values, which takes less time. Each
/// atom of the objects must be in one group.
std::vector<AreaColumn> area_sums(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                  SurfaceKind kind, std::span<const AtomGroup> groups);

/// Returns the columns "ses_area" and "sas_area" for a solvent-excluded surface, else the area of the computed surface.
/// An atom in several objects has the sum over one copy of each object.
std::vector<AreaColumn> area_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                     SurfaceKind kind);

/// A derivative by the position of each atom of a structure.
struct GradientColumn {
  std::string name;  ///< "ses_area", "ses_volume", "sas_area", "sas_volume", "vdw_area", "vdw_volume"; a constant
  Gradient values;   ///< Å²/Å, or Å³/Å
};

/// Returns the derivatives of the area and volume of the computed surface, summed over objects; for a solvent-excluded
/// surface, the derivatives of the accessible surface too. Objects must be surfaces of whole groups of atoms. Throws
/// InputError, naming the atoms, where a probe touches more than three.
std::vector<GradientColumn> gradient_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                             SurfaceKind kind);

}  // namespace meniscus
