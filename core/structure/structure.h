// SPDX-License-Identifier: BSD-3-Clause
// A molecule as read from a file: its atoms, groups of them, and counts of what was read, left out and used.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/rigid_motion.h"

namespace meniscus {

struct Ball;
struct RigidMotion;

/// What an atom belongs to. `unclassified`: the format does not say (XYZ, XYZR).
enum class AtomClass : std::uint8_t { polymer, ligand, water, ion, unclassified };

/// "polymer", "ligand", "water", "ion" or "unclassified".
const char* class_name(AtomClass kind);

/// What radii a file gives its atoms. `if_asked`: others than those of van der Waals, which count only where they are
/// asked for.
enum class FileRadii : std::uint8_t { none, if_asked, usual };

/// Secondary structure of a residue. `unknown`: not determined yet; `coil`: neither of the others.
enum class SecondaryStructure : std::uint8_t { unknown, coil, helix, strand };

/// One atom. Text fields come from the file as they are: never paste them into the source code of another program.
struct Atom {
  glm::dvec3 position{0.0};  ///< Å
  double radius = 0.0;  ///< van der Waals radius in Å: from the file (PQR, XYZR), or 0 until a radii set fills it in
  std::uint8_t element = 0;  ///< atomic number; 0: unknown, or the format does not say
  AtomClass kind = AtomClass::unclassified;
  char insertion_code = ' ';
  char altloc = ' ';          ///< letter of the alternate location, blank for none
  std::uint32_t index = 0;    ///< place in the file, from 0, counting every atom of every model that was read
  std::uint32_t residue = 0;  ///< running number of the residue, from 0; residues whose numbers wrapped stay distinct
  std::int32_t model = 1;     ///< which model of the file, from 1; those of added files go on counting
  std::int32_t residue_number = 0;
  float occupancy = std::numeric_limits<float>::quiet_NaN();  ///< NaN: missing
  float b_factor = std::numeric_limits<float>::quiet_NaN();   ///< Å²; NaN: missing
  float charge = std::numeric_limits<float>::quiet_NaN();     ///< partial charge in e; NaN: the format gives none
  std::string name;
  std::string residue_name;
  std::string chain;
  std::string subchain;    ///< label_asym_id of mmCIF, which assemblies name; else the chain
  std::string segment;     ///< segment identifier of PDB (columns 73 to 76), which molecular dynamics programs write
  std::uint32_t copy = 0;  ///< in an assembly: which copy, from 0
  /// pLDDT, 0 to 100, where the file lists it apart from B-factors; NaN: it does not.
  float confidence = std::numeric_limits<float>::quiet_NaN();
  std::uint16_t shown = 0;                                     ///< bit n: the n-th of ReadOptions::shown selects it
  SecondaryStructure secondary = SecondaryStructure::unknown;  ///< of its residue
};

/// "'CA' in ALA A12", for messages; "'C' (atom 5)" where the format knows no residues. Nothing is escaped but the name.
std::string label_of(const Atom& atom);

/// Something odd about a file that did not stop the program.
struct Warning {
  Warning(std::string sentence, std::vector<std::string> each = {})
      : text(std::move(sentence)), details(std::move(each)) {}

  std::string text;                  ///< one sentence with the count and the first case
  std::vector<std::string> details;  ///< a line for every case, where there are several
};

/// How many atoms a file holds and where they went: read == sum of excluded + used.
struct ReadReport {
  std::size_t read = 0;                         ///< every atom record of the file, all models and alternate locations
  std::map<std::string, std::size_t> excluded;  ///< reason -> atoms; an atom counts for the first reason it meets
  std::map<std::string, std::size_t> charged;   ///< those of `excluded` that have room and a partial charge
  std::size_t used = 0;
  std::size_t models = 1;  ///< models in the file, used or not
  std::string assembled;   ///< what an assembly made of the used atoms; empty: they are as deposited
  std::vector<Warning> warnings;

  /// "5,684 atoms read; 215 water left out; 5,469 used".
  std::string sentence() const;
};

/// "127 of radius zero, 58 water": atoms by the reason why they are left out, in the order of the reasons.
std::string reasons_text(const std::map<std::string, std::size_t>& excluded);

/// The reasons of ReadReport::excluded in the order they are tried.
inline constexpr const char* kExcludedModel = "other_model";
inline constexpr const char* kExcludedTrajectory = "not_in_trajectory";
inline constexpr const char* kExcludedAltloc = "altloc";
inline constexpr const char* kExcludedVirtual = "virtual_site";
inline constexpr const char* kExcludedSelection = "not_selected";
inline constexpr const char* kExcludedElement = "unknown_element";
inline constexpr const char* kExcludedRadius = "zero_radius";
inline constexpr const char* kExcludedHydrogen = "hydrogen";
inline constexpr const char* kExcludedWater = "water";
inline constexpr const char* kExcludedIon = "ion";
inline constexpr const char* kExcludedAssembly = "not_in_assembly";

/// Atoms that got the same radius for the same reason.
struct RadiusClass {
  std::string label;  ///< bonding class, force-field type, or element
  double radius;      ///< Å
  std::string source;
  std::size_t atoms;
};

/// Atoms that are at several places at once (--instances).
struct Instances {
  std::vector<std::uint32_t> atoms;  ///< into Structure::atoms, ascending
  std::vector<RigidMotion> motions;  ///< at least one
};

/// Chains that are together at these places.
struct AssemblyPart {
  std::vector<std::string> chains;  ///< Atom::subchain; empty: all
  std::vector<RigidMotion> motions;
};

/// A biological assembly as a file describes it.
struct Assembly {
  std::string id;           ///< as the file says, "1"
  std::string description;  ///< "tetrameric"; may be empty
  std::vector<AssemblyPart> parts;
};

/// Two atoms of a file, by their place in it (Atom::index), that are bonded.
using Bond = std::array<std::uint32_t, 2>;

/// A file's atoms before anything is left out, and its bonds: what the frames of a trajectory are about.
struct Topology {
  std::vector<Atom> atoms;         ///< of one model
  std::vector<Bond> bonds;         ///< those the file lists, which may be none or few
  bool without_positions = false;  ///< the file does not place its atoms: others did
};

/// A file whose atoms were added to those of another.
struct AddedFile {
  std::string file;                  ///< the path as given
  std::int32_t model = 0;            ///< Atom::model of its atoms, of the first of them if it has several
  std::size_t atoms = 0;             ///< all that were read
  std::optional<Superposition> fit;  ///< on the first file, by which all its atoms were moved

  /// "b.pdb is model 2, superposed on the first file by 214 atoms with an RMSD of 1.234 Å".
  std::string sentence() const;
};

/// The atoms a surface is made of, in file order.
struct Structure {
  std::string file;        ///< the path as given, or "standard input"
  std::string format;      ///< the reader's name for it: "PDB", "mmCIF", ...
  std::string experiment;  ///< by which the file says its atoms were found, "X-RAY DIFFRACTION"; empty: by none
  std::string radii_set;   ///< "bondi", "united", "protor", "file", or the files of radii
  std::vector<RadiusClass> radius_classes;
  std::vector<std::string>
      chains;                    ///< of the file and of those added, in order of appearance, whatever is used of them
  std::vector<AddedFile> added;  ///< files whose atoms come after those of `file`
  std::vector<Atom> atoms;
  std::vector<Atom> beside;  ///< those that are shown beside the surface, which is not made of them
  std::shared_ptr<const std::vector<Bond>> shown_bonds;  ///< of shown atoms: places in atoms with beside after them
  std::optional<std::uint64_t> frame;                    ///< of a run: its number in the trajectory
  std::vector<Instances> instances;          ///< each atom belongs to one; empty: all are where their positions say
  std::vector<Assembly> assemblies;          ///< those the file describes, if they were asked for
  std::shared_ptr<const Topology> topology;  ///< if it was asked for
  ReadReport report;
};

/// The atoms' van der Waals balls, one each, in order.
std::vector<Ball> balls_of(const Structure& structure);

enum class Grouping : std::uint8_t {
  chain,       ///< same model and chain
  model,       ///< same model
  atom_class,  ///< same AtomClass
  residue      ///< same residue
};

/// Some atoms and what to call them.
struct AtomGroup {
  std::string name;                  ///< text of the file may be in it: never into the source code of another program
  std::vector<std::uint32_t> atoms;  ///< indices into Structure::atoms, ascending
};

/// Every atom in exactly one group, in order of first appearance. Names: "chain A" ("chain A of model 2" when there are
/// several models; "unnamed chain" when the file gives none), "model 2", "ligand", "chain A 35B LEU".
std::vector<AtomGroup> group_atoms(const Structure& structure, Grouping by);

/// The chain as the file names it: in an assembly copies of A are called, ... and keep its colour.
std::string chain_of_file(const Atom& atom);

/// The different chains of some atoms, as the file names them, in order of appearance.
std::vector<std::string> chains_of(std::span<const Atom> atoms);

/// Where an atom is in its file: "chain A 35B LEU CD1", or "atom 12" (from 1) where the format has no names.
std::string atom_place(const Atom& atom);

}  // namespace meniscus
