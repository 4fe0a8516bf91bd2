// SPDX-License-Identifier: BSD-3-Clause
// Tables of van der Waals radii: the built-in sets, each with its source, and sets in users' files; and the choice of a
// radius for each atom from tables, sets and overrides, with its source.
#pragma once

#include <bitset>
#include <unordered_map>

#include "core/structure/selection/selection.h"

namespace meniscus {

/// A radius and its origin. The texts live as long as the table or set that they come from.
struct FoundRadius {
  double radius = 0.0;      ///< Å
  std::string_view label;   ///< class: "C4H2", an element, or a type of a force field
  std::string_view source;  ///< paper, file or option
};

/// A published set of radii.
struct RadiiSet {
  std::string_view name;  ///< name for --radii
  std::string_view description;
  std::string_view source;
  bool united;  ///< true if the radii include hydrogens, which are then left out
  /// Returns the radius of an atom; nothing if the set does not cover it.
  std::optional<FoundRadius> (*radius_of)(const Atom& atom);
};

extern const RadiiSet kBondiSet;
extern const RadiiSet kUnitedSet;
extern const RadiiSet kProtorSet;
extern const RadiiSet kMartini2Set, kMartini3Set;

std::span<const RadiiSet* const> radii_sets();

/// Returns the set with this name; null if there is none.
const RadiiSet* find_radii_set(std::string_view name);

/// Returns "bondi, united, protor, martini2, martini3, file".
std::string radii_set_names();

/// A pattern of names. It has alternatives "A|B", characters, ".", sets "[12A-D]" and "\" before a character, and after
/// each of these "*", "+" or "?". A lone "*" matches everything. Matching takes time proportional to the length of the
/// pattern times that of the text.
class NamePattern {
 public:
  /// Parses a pattern. Throws Error with a sentence if it uses anything else.
  explicit NamePattern(std::string_view text);

  /// True if the pattern matches the whole name.
  bool matches(std::string_view name) const;
  /// True if the pattern matches a name of a hydrogen, such as "HB1" or "1H".
  bool matches_hydrogen() const { return matches("H") || matches("HB1") || matches("1H"); }

 private:
  struct Piece {
    std::bitset<256> characters;
    bool is_optional = false;  // followed by `?` or `*`
    bool is_repeated = false;  // followed by + or *
  };
  static std::vector<Piece> pieces_of(std::string_view alternative);
  static bool matches(const std::vector<Piece>& pieces, std::string_view name);

  std::vector<std::vector<Piece>> alternatives_;
};

/// A table of radii. It may have two radii for an atom: one for molecules with hydrogens, and one that includes them.
class RadiiTable {
 public:
  struct Entry {
    double with_hydrogens = 0.0;  ///< Å; 0: the atom is left out
    double united = 0.0;          ///< Å
    std::string label;            ///< type or class, or "ALA CB"
  };

  RadiiTable(std::string source, std::string format) : source_(std::move(source)), format_(std::move(format)) {}

  /// Adds the radius of an atom in a residue. "*" stands for every residue without its own entry for the atom. An entry
  /// replaces an earlier one for the same atom.
  void add(const std::string& residue, const std::string& atom, const Entry& entry);
  /// Adds the radius of atoms by patterns, which are tried in order after the names.
  void add(NamePattern residue, NamePattern atom, const Entry& entry);

  /// Returns the radius of an atom, or nothing. It is looked up by the names as they are, then by canonical names
  /// (residue_names.h), and for hydrogens also with another last digit, because methylene hydrogens are numbered 1, 2
  /// or 2, 3.
  std::optional<FoundRadius> find(const Atom& atom, bool hydrogens_used) const;

  const std::string& source() const { return source_; }  ///< name of the file
  const std::string& format() const { return format_; }
  /// True if no hydrogen has a radius, so that the other radii must include hydrogens.
  bool united() const { return !has_hydrogens_; }
  bool empty() const { return names_.empty() && patterns_.empty(); }

 private:
  struct Rule {
    NamePattern residue, atom;
    Entry entry;
  };
  const Entry* find_named(const std::string& residue, const std::string& atom) const;

  std::string source_, format_;
  std::unordered_map<std::string, Entry> names_;  // key: "residue atom", as written and canonical
  std::vector<Rule> patterns_;
  bool has_hydrogens_ = false;
};

/// Reads files of radii, whose format is recognized by content: atom types with radius lines (MSMS's atmtypenumbers),
/// FreeSASA's .config, force fields of PDB2PQR (.DAT: residue atom charge radius), CHARMM topologies with their
/// parameters (both must be among the files; half of Rmin is the radius), or lines "RESIDUE ATOM RADIUS" with * or ANY
/// for every residue. Returns one table for each file, in order. All CHARMM files together have one table, at the place
/// of the last. Throws InputError with file and line.
std::vector<RadiiTable> read_radii_files(const std::vector<std::string>& paths);

/// A radius of some atoms that replaces any other.
struct RadiusOverride {
  Selection atoms;
  double radius;  ///< Å, greater than 0
};

struct RadiiOptions {
  /// "bondi", "united", "protor" or "file"; empty: "file" if the file has usual radii, else "bondi".
  std::string set{};
  /// Files for read_radii_files; the last one that covers an atom is used, then the set.
  std::vector<std::string> files{};
  std::vector<RadiusOverride> overrides{};  ///< the last one that selects an atom is used
  bool may_cover_none = false;  ///< if true, there is no error if neither set nor files have a radius for any atom
};

/// Parses "EXPR=R", split at the last "=". Throws SelectionError.
RadiusOverride parse_radius_override(const std::string& text);

/// The tables and sets from which radii are assigned.
class RadiiChoice {
 public:
  /// Reads the files. atoms: all atoms of the molecule file. Beads of Martini among them have the radii of their
  /// version if no set is requested. Throws InputError for an unknown set, a set without beads for a file with beads,
  /// "file" for a molecule file without radii, and a set or files that cover none of the atoms, and as read_radii_files
  /// does. `options` must outlive this object.
  RadiiChoice(const RadiiOptions& options, const std::string& molecule_file, FileRadii file_radii,
              std::span<const Atom> atoms = {});

  bool from_molecule_file() const { return from_file_; }
  /// True if the radii include hydrogens, so that hydrogens are left out unless the user keeps them. any_hydrogens:
  /// true if the molecule has hydrogens.
  bool united(bool any_hydrogens) const;

  /// Assigns a radius to every atom, and leaves out atoms of radius zero (which tables give to some hydrogens).
  /// Structure::radii_set and radius_classes are filled in. Warnings are added for atoms that neither files nor set
  /// cover, which get Bondi's radius of their element, for explicit hydrogens with united atoms, for elements without a
  /// published radius, and for overrides that select nothing. Returns the labels of atoms whose radius is a guess
  /// because their element is unknown.
  std::vector<std::string> assign(Structure& structure) const;

 private:
  struct Given {
    FoundRadius found;
    // False for Bondi's radius of the element, if the user chose other radii.
    bool is_covered = true;
  };
  void refuse_covering_none(const std::string& molecule_file, std::span<const Atom> atoms) const;
  Given radius_for(const Atom& atom, bool hydrogens_used) const;
  std::vector<Given> radii_for(const Structure& structure, bool hydrogens_used) const;
  void override_radii(Structure& structure, std::vector<Given>& given) const;
  void warn(Structure& structure, const std::vector<Given>& given) const;
  std::string name() const;

  const RadiiOptions& options_;
  std::vector<RadiiTable> tables_;
  const RadiiSet* set_ = &kBondiSet;
  bool from_file_ = false;
};

}  // namespace meniscus
