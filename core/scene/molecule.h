// SPDX-License-Identifier: BSD-3-Clause
// A molecule with its surface and colours, the share of the surface that a volume map covers, areas in the presence of
// other atoms, and the interface of two groups of atoms, opened like a book: both sides face the viewer, next to each
// other.
#pragma once

#include "core/base/progress.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/queries/surface_object.h"
#include "core/scene/surface_computer.h"
#include "core/scene/surface_objects.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Two groups of atoms, the left page and the right one.
struct InterfaceRequest {
  Selection left, right;
};

/// Reads "A:B" or "A,C:B" (chains), or "EXPR:EXPR". Throws RequestError, SelectionError.
InterfaceRequest parse_interface(std::string_view text);

/// Returns, per atom of the structure, by how much the other groups reduce the area of its sphere that the centre of
/// the probe can reach, Å². This is the solvent-accessible area that is buried (B. Lee and F. M. Richards, J. Mol.
/// Biol. 55, 379 (1971)); for a surface without a probe, the area of the surface itself. groups: must have every atom
/// once. Throws OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed, and Error if no part of it
/// is left.
std::vector<double> buried_areas(const Structure& structure, std::span<const AtomGroup> groups,
                                 SurfaceComputer& computer, SurfaceKind kind);

/// Returns the two groups; atoms that neither side selects are left out. Throws InputError for a group without atoms or
/// an atom in both.
std::vector<AtomGroup> interface_groups(const Structure& structure, const InterfaceRequest& interface);

/// The motions of the two groups: each is turned about one point and then moved to its side.
struct OpenPages {
  glm::dvec3 middle{0.0};  ///< the point of both turns, Å
  std::array<glm::dmat3, 2> turn{glm::dmat3(1.0), glm::dmat3(1.0)};
  std::array<double, 2> step{};  ///< Å along x, applied after the turn
};

/// Returns the motions after which the buried atoms of both groups, seen against +z, face the viewer. The page is the
/// plane that fits them best, with its longest axis upright; the left group is on the left, with a gap between. buried:
/// per atom. Throws InputError if nothing is buried.
OpenPages open_pages(const Structure& structure, std::span<const AtomGroup> groups, std::span<const double> buried);

/// Applies the motions to both groups.
void open_book(Structure& structure, std::span<const AtomGroup> groups, const OpenPages& pages);

/// The choice of atoms, of their surfaces and of their colours.
struct MoleculeRequest {
  std::string file;  ///< "-": standard input
  ReadOptions reading;
  std::optional<Selection> show;  ///< atoms whose part of the surface is drawn and exported; nothing: all
  SurfaceRequest surface;
  Division division;
  ColorScheme color;
  bool color_named = false;                   ///< true if the user set the scheme of all atoms
  std::optional<InterfaceRequest> interface;  ///< an interface to be opened like a book
  std::optional<Selection> patches;           ///< atoms whose contiguous areas are listed, and outlined in pictures
  double least_patch = 10.0;                  ///< Å²: smaller ones are left out
  std::string number_file;                    ///< numbers to colour by, for ColorScheme::By::file
  std::string number_column;                  ///< name of a column, if the number file is a table
  std::string volume_file;                    ///< a volume map to colour by, for ColorScheme::By::volume
  double volume_offset = 0.0;                 ///< Å outside of the surface where it is sampled
  std::string map_file;                       ///< path of a user's own colour map; empty: none
};

/// A molecule, ready to be drawn or exported.
struct Molecule {
  Structure structure;
  ColorScheme color;                   ///< the requested scheme with the numbers of its file
  std::vector<SurfaceObject> objects;  ///< there is at least one
  double beyond_map = 0.0;             ///< share of the surface, in [0, 1), that its volume map does not cover
  std::string device;                  ///< the device that computed the surfaces
  std::vector<StageTime> stages;       ///< times of the stages of all surfaces

  const Surface& surface() const { return objects.front().surface; }
  const Coloring& coloring() const { return objects.front().coloring; }
};

/// Returns the selected atoms; Structure::report says which atoms were read and which were left out. Throws InputError,
/// RequestError.
Structure read_molecule(const MoleculeRequest& request);

/// Opens the file for structures of the selected atoms at any positions. Throws InputError, RequestError.
std::unique_ptr<StructureFile> open_molecule(const MoleculeRequest& request);

/// Returns the colour scheme with the numbers of its file, if it has one. Throws InputError.
ColorScheme color_of(const MoleculeRequest& request);

/// Returns, per atom of the surface, true if it belongs to these patches. Throws RequestError if none does.
std::vector<bool> patch_atoms(const Selection& patches, const Structure& structure);

/// Groups of atoms, and the areas that they bury of each other.
struct Burial {
  std::vector<AtomGroup> groups;  ///< the sides of the interface, else the groups of the division, else the chains
  std::vector<double> areas;      ///< buried_areas() of each atom, Å²
};

/// Returns the burial in a structure whose interface is closed. Throws RequestError for copies as instances, InputError
/// for a side without atoms or an atom on both sides, and the errors of computing a surface (surface_objects).
Burial burial_of(const MoleculeRequest& request, const Structure& structure, SurfaceComputer& computer);

/// Throws RequestError for colours by copy where copies share one surface.
void require_colors_shared(const Structure& structure, const ColorScheme& color);

/// Makes molecules of one structure after another: the frames of a trajectory.
class MoleculeBuilder {
 public:
  /// `request` must outlive the builder, and so must `context`, if it is given; surfaces on GL are then computed
  /// in it. Throws InputError for the numbers of the colours, RequestError.
  explicit MoleculeBuilder(const MoleculeRequest& request, const EglContext* context = nullptr);

  /// Computes and colours the surfaces of a structure. Throws InputError if nothing is shown, if colours are by a
  /// number that the atoms do not have, or if no point of the surface lies in its volume map. Throws the errors of
  /// computing a surface (surface_objects), too.
  Molecule build(Structure structure);

  /// True if surfaces are computed on the CPU alone; then the builder may be used on any thread, by one at a time.
  bool is_on_cpu() const { return computer_.is_on_cpu(); }

  /// Returns the greatest share of a surface built so far that its volume map does not cover.
  double most_beyond_map() const { return most_beyond_map_; }

  /// Returns the computer, for further surfaces on the same device.
  SurfaceComputer& computer() { return computer_; }

 private:
  void measure_burial(Molecule& molecule);

  const MoleculeRequest& request_;
  ColorScheme color_;
  Division division_;
  SurfaceComputer computer_;
  double most_beyond_map_ = 0.0;
};

/// Returns the share in [0, 1] of the area with a volume map's colours that lies where the map has no values, measured
/// at points of all patches. It is exactly 0 if the atoms lie deep in the map, and 0 if nothing shows its colours.
double share_beyond(const VolumePaint& map, std::span<const SurfaceObject> objects);

/// The atoms in the surroundings of a molecule, and their effect on its areas.
struct ContextAreas {
  std::size_t atoms = 0;            ///< number of atoms of the context alone
  std::vector<AreaColumn> columns;  ///< two per given column: "<name>_in_context", "<name>_buried" (the difference)
};

/// Returns the request extended by the atoms of the context. Throws RequestError without --select (then the file has no
/// other atoms), for standard input, which can be read only once, and for assemblies.
MoleculeRequest with_context(const MoleculeRequest& request, const Selection& context);

/// Computes the surface of all atoms of `together` as one, and takes the areas of the molecule's atoms from it. alone:
/// the columns of the molecule without its context. computer: must compute the surfaces of request.surface. Throws
/// OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed, and Error if no part of it is left.
ContextAreas context_areas(const MoleculeRequest& request, const Structure& together, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone, SurfaceComputer& computer);

}  // namespace meniscus
