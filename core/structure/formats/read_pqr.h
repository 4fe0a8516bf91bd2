// SPDX-License-Identifier: BSD-3-Clause
// Takes the atom records of PQR apart, and tells them from those of PDB, which begin with the same words.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

/// An atom record of PQR; the numbers are still text, part of the line.
struct PqrRecord {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ', altloc = ' ';
  std::array<std::string_view, 5> numbers;  ///< x y z charge radius
};

/// Takes a record apart between blanks or, where fields touch, at PDB's columns; nothing if neither gives all fields.
/// Where both give the same coordinates and there is no chain between blanks, the columns are believed.
std::optional<PqrRecord> parse_pqr_record(std::string_view line);

/// What the atom records of a text may be, by the first hundred of them.
struct AtomRecordStyle {
  bool any = false;  ///< there are atom records
  bool pqr = false;  ///< most of them can be taken apart as PQR
  bool pdb = false;  ///< some have coordinates in PDB's columns, and they are not PQR only
};
AtomRecordStyle style_of_atom_records(std::string_view text);

}  // namespace meniscus
