// SPDX-License-Identifier: BSD-3-Clause
// Numbers for atoms or residues from a user's file, by which atoms can be coloured.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A residue as it is named in a file of numbers.
struct ResidueName {
  std::string chain;
  std::int32_t number = 0;
  char insertion_code = ' ';
  auto operator<=>(const ResidueName&) const = default;
};

/// The numbers of a file. Only one of four members is filled: `numbers` has one for each atom in order, `by_atom` and
/// `by_residue` have them by name, and `by_frame` has such tables for frames of a trajectory. NaN means that a number
/// is missing.
struct NumberFile {
  std::string path;
  std::vector<double> numbers{};              ///< one for each atom, in the order of atoms
  std::map<std::uint32_t, double> by_atom{};  ///< key: the atom's place in the molecule's file, from 0
  std::map<ResidueName, double> by_residue{};
  bool without_chains = false;  ///< true if by_residue has no chains, because the molecule has one
  std::string column{};         ///< name of the column; empty if columns have no names
  bool of_colors = false;       ///< true if numbers are colours, 0xrrggbb
  /// The numbers of each frame, by atom or by residue. The key is the number of the frame in its trajectory. Null: the
  /// numbers are the same in all frames.
  std::shared_ptr<const std::map<std::uint64_t, NumberFile>> by_frame{};

  bool empty() const { return numbers.empty() && by_atom.empty() && by_residue.empty() && !by_frame; }

  /// Returns the numbers of a frame, or, for no frame, of a structure that is not in a trajectory. Throws InputError if
  /// there are none.
  const NumberFile& of_frame(const std::optional<std::uint64_t>& frame) const;
  /// Returns the least and the greatest number of all frames, so that a colour has the same meaning in each of them.
  /// Returns nothing if numbers are not by frame or all are missing.
  std::optional<std::array<double, 2>> range_of_frames() const;
};

/// The layouts of read_number_file, as error messages describe them.
inline constexpr const char* kNumberLayouts =
    "write one number for each atom of the file or each atom used; or lines of chain, residue and number, such as A 12 "
    "0.5; or a table with a header "
    "such as chain,resid,score, or resid,score for a molecule of one chain. Columns may be parted by commas, "
    "semicolons, tabs or blanks";

/// Reads a file in one of three layouts. `nan`, `?` and `-` stand for a missing number, and `#` begins a comment.
/// - Numbers separated by blanks, commas and line ends, one for each atom.
/// - Lines with a chain, the number of a residue with its insertion code (52A), and a value. The first chain must not
///   be a number.
/// - A table with a header, as `meniscus surface --csv` and `--csv-residues` write it. The column "index" names the
///   atom; otherwise "chain", "number" (or "resid", "resi", "position", ...) and, if present, "icode" name the residue.
///   Molecules of one chain need no "chain". `column` is the name of the column of numbers. It may be left out if there
///   is only one other column, or none except one with a common name such as "class" or "radius". With a column
///   "frame", each row belongs to that frame of a trajectory. The numbers may be colours (#rrggbb).
/// Columns of the last two layouts are separated by tabs, semicolons, commas or blanks: the first of these that the
/// first line has. Unless commas separate columns, numbers may have a decimal comma. Empty cells, NA and N/A are
/// missing numbers, too.
/// Throws InputError with the line, the word and what is expected, and as read_text_file does.
NumberFile read_number_file(const std::string& path, const std::string& column = {});

}  // namespace meniscus
