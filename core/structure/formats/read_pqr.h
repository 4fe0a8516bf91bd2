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
/// The split at blanks is preferred if it found a chain; otherwise the columns are used if they give the same numbers.
std::optional<PqrRecord> parse_pqr_record(std::string_view line);

/// The formats that the atom records of a text may have, by the first hundred of them.
struct AtomRecordStyle {
  bool has_records = false;  ///< true if there are atom records
  bool is_pqr = false;       ///< true if at least half of them can be split as PQR
  /// True if a record has coordinates in PDB's columns, unless is_pqr is true and fewer than half of the records have
  /// occupancy and B-factor there; both can be true.
  bool is_pdb = false;
};
/// Returns the formats that the atom records of a text may have.
AtomRecordStyle style_of_atom_records(std::string_view text);

}  // namespace meniscus
