// SPDX-License-Identifier: BSD-3-Clause
// Records of PDB and PQR files: atoms, models, bonds and boxes that several readers share, the reader of PDB text, and
// a writer of models.
#pragma once

#include "core/base/output_file.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/structure.h"

namespace meniscus {

/// True if the line is this record, in upper or lower case. Names of records with fewer than six letters must be
/// followed by a blank.
bool is_pdb_record(std::string_view line, std::string_view record);

/// True if the line is ATOM or HETATM.
bool is_pdb_atom(std::string_view line);

/// Reads name, alternate location, residue name, chain (of one or two letters), segment and insertion code. A blank
/// chain is replaced by the segment. Columns missing at the end of the line are blank.
void read_pdb_names(std::string_view line, Atom& atom);

/// Parses "52" or, with an insertion code, "52A". Returns false for any other text, including a blank one; `number` is
/// then unchanged, and `insertion_code` may have changed.
bool parse_residue_number(std::string_view field, std::int32_t& number, char& insertion_code);

/// Reads residue numbers from the columns 23 to 26, or to 27 if the column of the insertion code has a digit. A number
/// is decimal, hybrid-36 (A000 is 10,000; R. W. Grosse-Kunstleve), or hexadecimal as VMD writes numbers above 9,999. A
/// hexadecimal number is recognized because it continues the count of the residues before it. Asterisks stand for a
/// number that did not fit: such residues are counted on from the last number, and a new one begins where the residue's
/// name changes or the name of an atom repeats.
class PdbResidueNumbers {
 public:
  /// Sets residue_number of an atom whose names were read (read_pdb_names). Returns false if the columns have no
  /// number; the atom's number is then counted on, or 0 if the columns are blank.
  bool read(std::string_view line, Atom& atom);

 private:
  std::int64_t count_on(const Atom& atom);

  std::int64_t last_ = 0;
  std::vector<std::string> counted_names_;  ///< names of atoms in the current residue with asterisks
  std::string counted_residue_;
};

/// Collects serial numbers and bond records while a file is read. The text of the file must outlive this object. Serial
/// numbers are compared as text, so that every numbering beyond 99,999 with distinct numbers works.
class PdbBonds {
 public:
  /// Adds the ATOM or HETATM record of the next atom, in the order of Atom::index. Only atoms of the first model that
  /// is read are added, because bonds are between these.
  void add_atom(std::string_view line);
  void add_record(std::string_view line) { records_.push_back(line); }
  /// Adds a bond between two serial numbers.
  void add_pair(std::string_view first, std::string_view second) { pairs_.push_back({first, second}); }

  /// Returns each bond once, the lower atom first, in ascending order. Bonds to a serial number that no atom has, or
  /// several atoms have, are ignored.
  std::vector<Bond> bonds() const;

 private:
  std::vector<std::string_view> serials_, records_;
  std::vector<std::array<std::string_view, 2>> pairs_;
};

/// A function that takes charge and element of an atom from the columns after the B-factor. Returns false if the
/// element is unknown. Throws InputError for columns that it cannot read.
using TrailingColumns = bool (*)(const TextFile& file, std::size_t line_number, std::string_view line, Atom& atom);

/// Reads the chosen models of a file: one by its number, or all (ModelChoice). `read_trailing` reads the columns after
/// the B-factor; it is nullptr for PDB, where these are segment and element. Throws InputError for an atom record
/// without coordinates and for a file without atoms.
FileContents read_pdb(const TextFile& file, const ModelChoice& models, TrailingColumns read_trailing);

/// A PDB file with models of the same atoms. The file appears only when it is complete: without commit() it is deleted.
/// Atoms of classes other than polymer are written as HETATM.
class PdbModels {
 public:
  /// Begins a file; an existing one is refused or replaced by commit() (Existing). `atoms` must outlive this object.
  /// Throws RequestError if they do not fit the format: more than 99,999, residue numbers below -999 or above 9999, and
  /// names of more than two letters for a chain, four for an atom or three for a residue. Throws OutputError.
  PdbModels(const std::filesystem::path& path, Existing existing, std::span<const Atom> atoms);

  /// Adds a model with these positions (Å), in the order of the atoms. Throws RequestError for coordinates beyond
  /// -999.999 and 9999.999 Å.
  void add(std::span<const glm::dvec3> positions);
  /// Completes the file and gives it its name. Throws OutputError.
  void commit();

 private:
  std::span<const Atom> atoms_;
  OutputFile file_;
  int models_ = 0;
};

/// The formats that the atom records of a text may have, by the first hundred of them.
struct AtomRecordStyle {
  bool has_records = false;  ///< true if there are atom records
  bool is_pqr = false;       ///< true if at least half of them can be split as PQR
  /// True if a record has coordinates in PDB's columns, unless is_pqr is true and fewer than half of the records have
  /// occupancy and B-factor there; both can be true.
  bool is_pdb = false;
};
AtomRecordStyle style_of_atom_records(std::string_view text);

}  // namespace meniscus
