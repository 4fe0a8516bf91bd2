// SPDX-License-Identifier: BSD-3-Clause
// The records of PDB files: fixed columns of atoms, which PQR and PDBQT share, CONECT bonds, and assemblies of REMARK
// 350.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

struct Atom;

/// True if the line is this record; letters of either case. Names shorter than six letters must be followed by a blank.
bool is_pdb_record(std::string_view line, std::string_view record);

/// True for ATOM and HETATM.
bool is_pdb_atom(std::string_view line);

/// Reads name, alternate location, residue name, chain (two letters too), segment and insertion code; the chain is the
/// segment where it is blank. Columns missing at the end are blank.
void read_pdb_names(std::string_view line, Atom& atom);

/// Reads "52" or, with an insertion code, "52A"; false for other texts.
bool parse_residue_number(std::string_view field, std::int32_t& number, char& insertion_code);

/// Residue numbers in the four columns 23 to 26 (five, if a digit is in the place of the insertion code): decimal;
/// hybrid-36 (A000 is 10,000; R. W. Grosse-Kunstleve); hexadecimal as VMD writes it above 9,999, which is distinguished
/// from the others by continuing the count; stars, counted on from the residue before by names that come again.
class PdbResidueNumbers {
 public:
  /// Sets residue_number of an atom whose names are read; false if the columns hold no number.
  bool read(std::string_view line, Atom& atom);

 private:
  std::int64_t count_on(const Atom& atom);

  std::int64_t last_ = 0;
  std::vector<std::string> counted_names_;  ///< of the residue under stars
  std::string counted_residue_;
};

/// Gathers serial numbers and records while a file is read; the text must outlive it. Serial numbers are compared as
/// text, so every way of numbering beyond 99,999 works that gives each atom its own.
class PdbBonds {
 public:
  /// The atom record of the next atom, in the order of Atom::index.
  void add_atom(std::string_view line);
  /// A CONECT record.
  void add_record(std::string_view line) { records_.push_back(line); }
  /// Two serial numbers.
  void add_pair(std::string_view first, std::string_view second) { pairs_.push_back({first, second}); }

  /// Each bond once, lower atom first, ascending. Records that name no atom, or a number that several atoms bear, are
  /// passed over.
  std::vector<Bond> bonds() const;

 private:
  std::vector<std::string_view> serials_, records_;
  std::vector<std::array<std::string_view, 2>> pairs_;
};

}  // namespace meniscus
