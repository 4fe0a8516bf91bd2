// SPDX-License-Identifier: BSD-3-Clause
// Reads the atoms for a surface from a file. By default these are the polymers of one model at one alternate location.
#pragma once

#include "core/structure/residues.h"
#include "core/structure/assembly.h"
#include "core/structure/radii/assign_radii.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The treatment of atoms of unknown element.
enum class UnknownElement { halt, guess, skip };

/// The treatment of hydrogens. `automatic`: kept with radii for explicit hydrogens, left out with united atoms.
enum class Hydrogens { automatic, keep, drop };

/// Atoms that are shown in another way than by a surface, such as sticks.
struct ShownAtoms {
  std::string option;  ///< name of the option that selects them, for messages: "sticks"
  /// Selection from the same atoms as ReadOptions::selection, with the same rule for water and ions.
  Selection atoms;
  bool each_is_drawn = false;  ///< true if every atom is drawn, as by sticks and spheres; then it has no companion
  std::string lack{};          ///< message of the error if there are no such atoms; empty: it names the option
};

/// The greatest number of ShownAtoms. Atom::shown has a bit for each of them.
inline constexpr std::size_t kMostShown = 16;

/// The choice of atoms of a file, and of further data to read.
struct ReadOptions {
  ModelChoice model{};      ///< the models to read
  AltlocChoice altloc{};    ///< the alternate location of each residue
  bool keep_water = false;  ///< true: water is used
  bool keep_ions = false;   ///< true: free ions are used, as in a file without other molecules
  UnknownElement unknown_element = UnknownElement::halt;  ///< guess: radius kRadiusWithoutSource; skip: left out
  std::string assembly{};                                 ///< id of the assembly to build; empty: as in the file
  CopyMode copy_mode = CopyMode::atoms;                   ///< representation of its copies
  bool list_assemblies = false;                           ///< if true, Structure::assemblies is filled in
  std::vector<std::string> added{};  ///< names of further files, whose atoms are added as further models
  /// The atoms by which each added file is superposed on the first, selected in both (AddedFiles).
  std::optional<Selection> superpose_on{};
  /// Selects the atoms to use. It is evaluated on all atoms, including water and ions, except for virtual sites and the
  /// atoms of other models and other alternate locations. Selected water and ions are used only if the expression names
  /// them (Selection::names) or with keep_water or keep_ions. Without a selection the polymers of the file are used,
  /// and everything of a file that has none (OutsidePolymer in residues.h).
  std::optional<Selection> selection = {};
  bool takes_ligands = false;                  ///< true: without a selection, ligands and lipids are used, too
  std::vector<Selection> required_parts = {};  ///< parts of the selection, each of which must have atoms
  Hydrogens hydrogens = Hydrogens::automatic;
  RadiiOptions radii{};
  bool keep_topology = false;  ///< if true, Structure::topology is filled in
  /// The atoms of the frames of a trajectory, if these are not all atoms of the file. Other atoms are left out before
  /// anything else, and Atom::index counts the atoms that are left. It may use names and classes, and positions only if
  /// the file has them.
  std::optional<Selection> trajectory_atoms = {};
  /// The positions (Å) of all atoms of a file without positions (PSF), in the order of the file.
  std::vector<glm::dvec3> positions{};
  /// Atoms to show, at most kMostShown entries. Atom::shown, Structure::extra_atoms and, for all shown atoms,
  /// shown_bonds are filled in.
  std::vector<ShownAtoms> shown{};
  /// If not `none`, companions are marked in Atom::shown and kept as `shown` atoms are, unless these draw them. There
  /// are none with a selection.
  Companions companions = Companions::none;
  bool secondary_structure = false;  ///< if true, Atom::secondary is computed for all atoms (secondary_structure.h)
};

/// Reads a file of any format in structure_formats.h, plain or gzipped; "-" is standard input. The default is: polymers
/// with their bound sugars, or all of a file without a polymer; no water and free ions, the first model, the best
/// alternate location, and the radii of the file (XYZR, PQR) or else Bondi's radii.
/// Throws InputError as read_text_file and the readers do, and if there is no such model, nothing is selected, no atoms
/// are left, or elements are unknown. Throws CapacityError.
Structure read_structure(const std::string& path, const ReadOptions& options = {});

/// A file that is read once, for structures of its atoms at any positions.
class StructureFile {
 public:
  /// Reads the file. Throws as read_structure does.
  StructureFile(const std::string& path, const ReadOptions& options);
  ~StructureFile();
  StructureFile(const StructureFile&) = delete;
  StructureFile& operator=(const StructureFile&) = delete;

  /// Returns all atoms that at() may use or show, at the positions of the file or of the options.
  const Structure& possible_structure() const { return possible_structure_; }

  /// Returns the structure that read_structure gives for other positions (Å), one for each atom of the file or of
  /// ReadOptions::trajectory_atoms. Atoms of added files are superposed on them if requested, and stay otherwise. A
  /// selection of ReadOptions::shown may be empty. Bonds are those found in possible_structure(), so that they do not
  /// change. Throws as read_structure does.
  Structure at(std::span<const glm::dvec3> positions) const;

 private:
  friend Structure read_structure(const std::string& path, const ReadOptions& options);
  struct Parts;
  std::unique_ptr<Parts> parts_;
  Structure possible_structure_;
};

/// Returns the number of atoms in the first model of the file, or of those that belong to a trajectory
/// (ReadOptions::trajectory_atoms). Throws as read_structure does.
std::size_t count_atoms(const std::string& path, const std::optional<Selection>& trajectory_atoms);

}  // namespace meniscus
