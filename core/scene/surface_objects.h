// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of a structure as objects, atoms whose surface is hidden, and areas of atoms and their derivatives, as
// columns of tables.
#pragma once

#include "core/queries/surface_object.h"
#include "core/scene/surface_computer.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/surface/measure.h"

namespace meniscus {

/// The closed parts of the surface that are used.
enum class Cavities {
  keep,  ///< all parts
  drop,  ///< the parts that the outside reaches: no cavities, and nothing inside one
  only   ///< cavities, and what is inside them
};

/// The treatment of the copies of an assembly.
enum class InstanceMode {
  none,     ///< atoms of copies are atoms like all others, under one surface
  exact,    ///< one copy is computed; an error unless that gives the surface of the whole
  separate  ///< one copy is computed as if it were alone
};

/// The division of the surface into objects.
struct Division {
  std::optional<Grouping> groups;  ///< one surface for each group of atoms, as if it were alone
  bool components = false;         ///< true: each closed part is an object
  Cavities cavities = Cavities::keep;
  InstanceMode instances = InstanceMode::none;
};

/// Returns closed surfaces with their names and atoms, not yet coloured. With --cavities a group of atoms may have
/// none. Throws OpenSurfaceError, naming atoms by chain, residue and name; CapacityError, GpuError; Error if no part of
/// the surface is left.
std::vector<SurfaceObject> surface_objects(const Structure& structure, const Division& division,
                                           SurfaceComputer& computer);

/// Throws InputError, naming two atoms, if one probe can touch two copies of the structure at once: then copies of one
/// surface are not the surface of the whole.
void require_apart(const Structure& structure, double probe_radius);

/// The largest values of the certificates of all objects, Å; usually 0. grown_by: the growth of radii by which ties are
/// decided. exact_within: the surfaces are exact for radii that differ from the given ones by at most this.
struct RadiiChange {
  double grown_by = 0.0;      ///< Å
  double exact_within = 0.0;  ///< Å
};
RadiiChange change_of_radii(const std::vector<SurfaceObject>& objects);

/// Returns, per atom of the structure, true if it is not selected. The expression may refer to atoms that are drawn in
/// addition to the surface. Throws InputError if nothing would be visible.
std::vector<bool> hidden_atoms(const Selection& shown, const Structure& structure);

/// Hides the points of these atoms in every object. hidden: per atom of the structure.
void hide(const std::vector<bool>& hidden, std::vector<SurfaceObject>& objects);

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
