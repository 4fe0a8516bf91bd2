// SPDX-License-Identifier: BSD-3-Clause
// A molecule as read from a file: its atoms, groups of them, and counts of what was read, left out and used.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/rigid_motion.h"

namespace meniscus {

struct Ball;

/// The class of an atom. `unclassified`: the format has no classes (XYZ, XYZR).
enum class AtomClass : std::uint8_t { polymer, ligand, water, ion, unclassified };

/// Returns "polymer", "ligand", "water", "ion" or "unclassified".
const char* class_name(AtomClass kind);

/// The radii in a file. `none`: there are none; `usual`: they are van der Waals radii, which are used unless the user
/// chooses others; `on_request`: they are for another purpose, such as implicit solvents, and are used only if the user
/// asks.
enum class FileRadii : std::uint8_t { none, on_request, usual };

/// The secondary structure of a residue. `unknown`: not determined yet; `coil`: neither helix nor strand.
enum class SecondaryStructure : std::uint8_t { unknown, coil, helix, strand };

/// An atom. Its texts are as in the file and must never be inserted into the source code of another program.
struct Atom {
  glm::dvec3 position{0.0};  ///< Å
  double radius = 0.0;  ///< van der Waals radius in Å, from the file (PQR, XYZR) or a set of radii; 0 until it is set
  std::uint8_t element = 0;  ///< atomic number; 0: unknown
  AtomClass kind = AtomClass::unclassified;
  char insertion_code = ' ';
  char altloc = ' ';        ///< letter of the alternate location, blank for none
  std::uint32_t index = 0;  ///< place in the file, from 0, counting all atoms of all models that were read
  /// Number of the residue, from 0; two residues never share it, even if residue_number starts again in a large file.
  std::uint32_t residue = 0;
  std::int32_t model = 1;  ///< number of the model, from 1; models of added files continue the count
  std::int32_t residue_number = 0;
  float occupancy = std::numeric_limits<float>::quiet_NaN();  ///< NaN: missing
  float b_factor = std::numeric_limits<float>::quiet_NaN();   ///< Å²; NaN: missing
  float charge = std::numeric_limits<float>::quiet_NaN();     ///< partial charge in e; NaN: not in the format
  std::string name;
  std::string residue_name;
  std::string chain;
  std::string subchain;    ///< label_asym_id of mmCIF, by which assemblies name chains; otherwise the chain
  std::string segment;     ///< segment identifier of PDB (columns 73 to 76), as molecular dynamics programs write it
  std::uint32_t copy = 0;  ///< number of the copy in an assembly, from 0
  /// pLDDT, 0 to 100, if the file has it separately from B-factors; otherwise NaN.
  float confidence = std::numeric_limits<float>::quiet_NaN();
  /// Bit n is set if the n-th set of atoms drawn in addition to the surface has the atom (ReadOptions::shown), and one
  /// of the bits kCompanionSticks and so on if the atom is one of its companions.
  std::uint32_t shown = 0;
  SecondaryStructure secondary = SecondaryStructure::unknown;  ///< secondary structure of its residue
};

/// The companions of a surface: ligands and ions that it leaves out because it is that of a polymer, and that pictures
/// draw in addition to it. `none`: there are none; `hidden`: they are not drawn, but selections may see them.
enum class Companions : std::uint8_t { none, hidden, drawn };

/// The bits of Atom::shown for companions.
inline constexpr std::size_t kCompanionSticks = 29;   ///< drawn as sticks
inline constexpr std::size_t kCompanionSpheres = 30;  ///< drawn as spheres
inline constexpr std::size_t kHiddenCompanion = 31;   ///< not drawn, but selections see the atom
inline constexpr std::uint32_t kCompanionBits =
    1u << kCompanionSticks | 1u << kCompanionSpheres | 1u << kHiddenCompanion;
/// True if the atom is drawn in addition to a surface.
inline bool is_drawn_beside(const Atom& atom) { return (atom.shown & ~(1u << kHiddenCompanion)) != 0; }

/// Returns "'CA' in ALA A12" for messages, or "'C' (atom 5)" if the format has no residues. Only the name is escaped.
std::string label_of(const Atom& atom);

/// A problem of a file that did not stop the program.
struct Warning {
  Warning(std::string sentence, std::vector<std::string> each = {})
      : text(std::move(sentence)), details(std::move(each)) {}

  std::string text;                  ///< one sentence with the number of cases and the first case
  std::vector<std::string> details;  ///< one line for every case if there are several
};

/// The number of atoms in a file, and how they were used: `read` is the sum of all numbers in `excluded` and of `used`.
struct ReadReport {
  std::size_t read = 0;  ///< all atom records of the file, with all models and alternate locations
  /// Number of atoms for each reason, one of kExcludedModel and the following; an atom counts for the first reason that
  /// applies.
  std::map<std::string, std::size_t> excluded;
  /// Like `excluded`, but it counts only atoms that have a partial charge and occupy space. Atoms that are excluded as
  /// kExcludedAltloc, kExcludedVirtual or kExcludedRadius do not occupy any.
  std::map<std::string, std::size_t> charged;
  /// The number of residues by their name, for kExcludedLigand and kExcludedLipid.
  std::map<std::string, std::map<std::string, std::size_t>> residues;
  std::size_t used = 0;
  std::size_t models = 1;  ///< number of models in the file
  std::string assembled;   ///< description of the assembly of the used atoms; empty without an assembly
  std::vector<Warning> warnings;

  /// Returns "5,684 atoms read; 43 ligand atoms (HEM), 215 water atoms left out; 5,426 used".
  std::string sentence() const;
};

/// Returns "127 of radius zero, 58 water atoms": the number of atoms for each reason, in the order of the constants
/// below. residues: as in ReadReport.
std::string reasons_text(const std::map<std::string, std::size_t>& excluded,
                         const std::map<std::string, std::map<std::string, std::size_t>>& residues = {});

/// The reasons of ReadReport::excluded, in the order in which they are tried.
inline constexpr const char* kExcludedModel = "other_model";  ///< the atom's model is not read
/// The atom is not in the trajectory, which has fewer atoms than the file.
inline constexpr const char* kExcludedTrajectory = "not_in_trajectory";
inline constexpr const char* kExcludedAltloc = "altloc";  ///< the atom is at an alternate location that was not chosen
/// The place has no atom, such as that of a lone pair or dummy atom.
inline constexpr const char* kExcludedVirtual = "virtual_site";
inline constexpr const char* kExcludedSelection = "not_selected";  ///< the selection does not contain the atom
/// The element is unknown, and such atoms are to be skipped.
inline constexpr const char* kExcludedElement = "unknown_element";
inline constexpr const char* kExcludedRadius = "zero_radius";  ///< the radius in the file is 0
/// The atom is a hydrogen, and radii are those of united atoms, or the user leaves it out.
inline constexpr const char* kExcludedHydrogen = "hydrogen";
inline constexpr const char* kExcludedWater = "water";  ///< water that was not requested
inline constexpr const char* kExcludedIon = "ion";      ///< a free ion that was not requested
/// The atom is in a ligand or lipid that no polymer has bound; no atoms are selected, and the file has a polymer.
inline constexpr const char* kExcludedLigand = "ligand";
inline constexpr const char* kExcludedLipid = "lipid";
inline constexpr const char* kExcludedAssembly = "not_in_assembly";  ///< the assembly does not contain the atom's chain

/// Atoms that have the same radius for the same reason.
struct RadiusClass {
  std::string label;   ///< bonding class, force-field type, or element
  double radius;       ///< Å
  std::string source;  ///< origin of the radius: a paper, a file or an option, as text for people
  std::size_t atoms;
};

/// Atoms, and the motions to their copies in an assembly (--instances).
struct Instances {
  std::vector<std::uint32_t> atoms;  ///< indices into Structure::atoms, ascending
  /// From Atom::position to each copy, at least one; the identity is among them only if the file lists it.
  std::vector<RigidMotion> motions;
};

/// Chains that have the same motions in an assembly.
struct AssemblyPart {
  std::vector<std::string> chains;   ///< values of Atom::subchain; empty: all chains
  std::vector<RigidMotion> motions;  ///< motions from the positions in the file to each copy, at least one
};

/// A biological assembly as described in a file.
struct Assembly {
  std::string id;           ///< identifier in the file, such as "1"
  std::string description;  ///< "tetrameric"; may be empty
  std::vector<AssemblyPart> parts;
};

/// Two bonded atoms of a file, by their place in it (Atom::index).
using Bond = std::array<std::uint32_t, 2>;

/// The atoms of a file before any are left out, and its bonds. Frames of a trajectory have these atoms.
struct Topology {
  std::vector<Atom> atoms;         ///< atoms of one model
  std::vector<Bond> bonds;         ///< bonds that the file lists, perhaps none or only some
  bool without_positions = false;  ///< true if the file has no coordinates, and another file gave them
};

/// A file whose atoms were added to the atoms of another file.
struct AddedFile {
  std::string file;                  ///< path as the user wrote it
  std::int32_t model = 0;            ///< Atom::model of its first atom
  std::size_t atoms = 0;             ///< number of atoms that were read
  std::optional<Superposition> fit;  ///< superposition on the first file, by which all its atoms were moved

  /// Returns "b.pdb is model 2, superposed on the first file by 214 atoms with an RMSD of 1.234 Å".
  std::string sentence() const;
};

/// The atoms that a surface is computed for, in file order.
struct Structure {
  std::string file;        ///< path as the user wrote it, or "standard input"
  std::string format;      ///< name of the format: "PDB", "mmCIF", ...
  std::string experiment;  ///< experimental method named in the file, "X-RAY DIFFRACTION"; empty if there is none
  std::string radii_set;   ///< "bondi", "united", "protor", "file", or the names of files of radii
  std::vector<RadiusClass> radius_classes;
  /// All chains of the file and of added files in order of appearance, whether or not they are used.
  std::vector<std::string> chains;
  std::vector<AddedFile> added;  ///< files whose atoms follow the atoms of `file`
  std::vector<Atom> atoms;
  std::vector<Atom> extra_atoms;  ///< atoms that are shown in addition to the surface, which is not computed for them
  /// Bonds of the atoms that are drawn in addition to the surface, as places in `atoms` followed by `extra_atoms`. It
  /// may be null if there are no such atoms.
  std::shared_ptr<const std::vector<Bond>> shown_bonds;
  Companions companions = Companions::none;
  std::optional<std::uint64_t> frame;  ///< number of the frame in its trajectory, from 0; none without a trajectory
  /// Copies: each of `atoms` is in exactly one entry; empty: atoms are only at their positions.
  std::vector<Instances> instances;
  std::vector<Assembly> assemblies;          ///< assemblies that the file describes; empty unless requested
  std::shared_ptr<const Topology> topology;  ///< null unless requested
  ReadReport report;
};

/// Returns the van der Waals balls of the atoms, in order.
std::vector<Ball> balls_of(const Structure& structure);

/// The property by which atoms are grouped.
enum class Grouping : std::uint8_t {
  chain,       ///< same model and chain
  model,       ///< same model
  atom_class,  ///< same AtomClass
  residue      ///< same residue
};

/// A group of atoms and its name.
struct AtomGroup {
  /// The name may contain text of the file, which must never be inserted into the source code of another program.
  std::string name;
  std::vector<std::uint32_t> atoms;  ///< indices into Structure::atoms, ascending
};

/// Groups the atoms so that each is in exactly one group. Groups are in order of first appearance. Their names are
/// "chain A" ("chain A of model 2" if there are several models; "unnamed chain" if the file has no name), "model 2",
/// "ligand", "chain A 35B LEU".
std::vector<AtomGroup> group_atoms(const Structure& structure, Grouping by);

/// Returns the chain of an atom as it is named in the file. Copies of chain A in an assembly are named, ...
/// (Atom::chain); this function returns A for each of them.
std::string chain_of_file(const Atom& atom);

/// Returns the distinct chains of some atoms as they are named in the file, in order of appearance.
std::vector<std::string> chains_of(std::span<const Atom> atoms);

/// Returns the location of an atom in its file: "chain A 35B LEU CD1", or "atom 12" (from 1) without names.
std::string atom_place(const Atom& atom);

}  // namespace meniscus
