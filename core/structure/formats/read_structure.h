// SPDX-License-Identifier: BSD-3-Clause
// Reads the atoms of a surface from a file: format by content, one model, one alternate location, no water, no ions.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/structure/residues.h"
#include "core/structure/assembly.h"
#include "core/structure/radii/assign_radii.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// What to do with atoms of unknown element.
enum class UnknownElement { halt, guess, skip };

/// What to do with hydrogens. `automatic`: kept with radii for explicit hydrogens, left out with united atoms.
enum class Hydrogens { automatic, keep, drop };

/// Atoms that something else than a surface shows, such as sticks.
struct ShownAtoms {
  std::string option;  ///< that asks for them, for messages: "sticks"
  Selection atoms;     ///< of the same atoms as ReadOptions::selection, with the same rule for water and ions
};

/// As many as Atom::shown has bits.
inline constexpr std::size_t kMostShown = 16;

struct ReadOptions {
  ModelChoice model{};
  AltlocChoice altloc{};
  bool keep_water = false;
  bool keep_ions = false;
  UnknownElement unknown_element = UnknownElement::halt;  ///< guess: radius kRadiusWithoutSource; skip: leave out
  std::string assembly{};                                 ///< id of the assembly to build; empty: as deposited
  CopyMode copy_mode = CopyMode::atoms;                   ///< what becomes of its copies
  bool list_assemblies = false;                           ///< fill in Structure::assemblies
  std::vector<std::string> added{};  ///< further files, whose atoms come after those of the first as further models
  std::optional<Selection> superpose_on{};  ///< of both: each added file is superposed on the first (AddedFiles)
  /// Evaluated on what other models, altlocs and virtual sites leave, water and ions included. Water and ions that it
  /// selects are used only if it names them (Selection::names) or keep_water, keep_ions.
  std::optional<Selection> selection = {};
  std::vector<Selection> sides = {};  ///< parts of it, each of which must have atoms
  Hydrogens hydrogens = Hydrogens::automatic;
  RadiiOptions radii{};
  bool keep_topology = false;  ///< fill in Structure::topology
  /// The atoms that the frames of a trajectory have, where these are not all of the file: the others are left out
  /// before anything else, and Atom::index counts what is left. By names and classes; positions only where the file
  /// has them.
  std::optional<Selection> trajectory_atoms = {};
  /// Where the atoms of a file without positions (PSF) are, Å, one each in the order of the file.
  std::vector<glm::dvec3> positions{};
  /// Fills in Atom::shown, Structure::beside and, of all shown atoms, shown_bonds. At most kMostShown.
  std::vector<ShownAtoms> shown{};
  bool secondary_structure = false;  ///< fill in Atom::secondary of all atoms (secondary_structure.h)
};

/// Reads a file of any format in formats.h, plain or gzipped; "-" is standard input. Default: polymer and ligands in,
/// water and free ions out, first model, best alternate location. Radii: the file's own (XYZR, PQR), else
/// Bondi's.
/// Throws InputError (see read_text_file and the readers; no such model; nothing selected; no atoms left; unknown
/// elements), CapacityError.
Structure read_structure(const std::string& path, const ReadOptions& options = {});

/// A file that is read once, for structures of its atoms wherever they are.
class StructureFile {
 public:
  /// Throws as read_structure.
  StructureFile(const std::string& path, const ReadOptions& options);
  ~StructureFile();
  StructureFile(const StructureFile&) = delete;
  StructureFile& operator=(const StructureFile&) = delete;

  /// All atoms that at() takes or marks anywhere, where the file or the options place them.
  const Structure& reach() const { return reach_; }

  /// What read_structure gives for atoms that are there: one position, Å, of each atom of the file, or of
  /// ReadOptions::trajectory_atoms. Atoms of added files are superposed on them, if they are to be, or stay.
  /// ReadOptions::shown may mean none of them, and bonds are those found in reach(), so that they stay. Throws as
  /// read_structure.
  Structure at(std::span<const glm::dvec3> positions) const;

 private:
  friend Structure read_structure(const std::string& path, const ReadOptions& options);
  struct Parts;
  std::unique_ptr<Parts> parts_;
  Structure reach_;
};

/// How many atoms the first model of the file has, or how many of them are those of a trajectory
/// (ReadOptions::trajectory_atoms). Throws as read_structure.
std::size_t count_atoms(const std::string& path, const std::optional<Selection>& trajectory_atoms);

}  // namespace meniscus
