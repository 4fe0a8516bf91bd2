// SPDX-License-Identifier: BSD-3-Clause
// Radii of atoms by name, from the tables that other programs use, and the patterns of names in these.
#pragma once

#include <bitset>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/structure/radii/radii_set.h"

namespace meniscus {

/// Alternatives "A|B", characters, ".", sets "[12A-D]", "\" before a character, and after each of these "*", "+" or
/// "?". A lone "*" matches everything. Matching takes time proportional to pattern times text.
class NamePattern {
 public:
  /// Throws Error with a sentence if the pattern uses something else.
  explicit NamePattern(std::string_view text);

  /// Does the whole name match?
  bool matches(std::string_view name) const;
  /// Does it match a name of hydrogen, such as "HB1" or "1H"?
  bool matches_hydrogen() const { return matches("H") || matches("HB1") || matches("1H"); }

 private:
  struct Piece {
    std::bitset<256> characters;
    bool optional = false;  // ? or *
    bool repeated = false;  // + or *
  };
  static std::vector<Piece> pieces_of(std::string_view alternative);
  static bool matches(const std::vector<Piece>& pieces, std::string_view name);

  std::vector<std::vector<Piece>> alternatives_;
};

/// A table of radii. Where it has two, one is for molecules with hydrogens, one contains them.
class RadiiTable {
 public:
  struct Entry {
    double with_hydrogens = 0.0;  ///< Å; 0: no ball, the atom is left out
    double united = 0.0;          ///< Å
    std::string label;            ///< type or class, or "ALA CB"
  };

  RadiiTable(std::string source, std::string format) : source_(std::move(source)), format_(std::move(format)) {}

  /// Residue "*" stands for every residue that has no entry for the atom. A later entry for the same atom replaces.
  void add(const std::string& residue, const std::string& atom, const Entry& entry);
  /// Patterns are tried in order, after the names.
  void add(NamePattern residue, NamePattern atom, const Entry& entry);

  /// Tries the names as they are, then canonical ones (residue_names.h), of hydrogens also those with another last
  /// digit (methylene hydrogens are numbered 1, 2 or 2, 3).
  std::optional<FoundRadius> find(const Atom& atom, bool hydrogens_used) const;

  const std::string& source() const { return source_; }  ///< the file
  const std::string& format() const { return format_; }
  /// No hydrogen has a radius of its own, so that the other radii must contain them.
  bool united() const { return !has_hydrogens_; }
  bool empty() const { return names_.empty() && patterns_.empty(); }

 private:
  struct Rule {
    NamePattern residue, atom;
    Entry entry;
  };
  const Entry* find_named(const std::string& residue, const std::string& atom) const;

  std::string source_, format_;
  std::unordered_map<std::string, Entry> names_;  // "residue atom", as written and canonical
  std::vector<Rule> patterns_;
  bool has_hydrogens_ = false;
};

/// Reads files, recognized by content: atom types with radius lines (MSMS's atmtypenumbers), FreeSASA's .config, force
/// fields of PDB2PQR (.DAT: residue atom charge radius), CHARMM topologies with their parameters (both must be among
/// the files; half of Rmin is the radius), or lines "RESIDUE ATOM RADIUS" with * or ANY for every residue. One table a
/// file, in order; one for all CHARMM files, in the place of the last. Throws InputError with file and line.
std::vector<RadiiTable> read_radii_files(const std::vector<std::string>& paths);

}  // namespace meniscus
