// SPDX-License-Identifier: BSD-3-Clause
// Splits the atom records of PQR, and distinguishes them from those of PDB, which begin with the same words.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

/// An atom record of PQR, with its numbers as text that is part of the line.
struct PqrRecord {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ', altloc = ' ';
  std::array<std::string_view, 5> numbers;  ///< x y z charge radius
};

/// Splits a record at blanks or, if fields touch, at the columns of PDB. Returns nothing if neither gives all fields.
/// If both give the same coordinates and there is no chain between blanks, the columns are used.
std::optional<PqrRecord> parse_pqr_record(std::string_view line);

/// The formats that the atom records of a text may have, by the first hundred of them.
struct AtomRecordStyle {
  bool has_records = false;  ///< true if there are atom records
  bool is_pqr = false;       ///< true if most of them can be split as PQR
  bool is_pdb = false;       ///< true if some have coordinates in PDB's columns and they are not clearly PQR
};
/// Returns the formats that the atom records of a text may have.
AtomRecordStyle style_of_atom_records(std::string_view text);

}  // namespace meniscus
