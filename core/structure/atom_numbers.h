// SPDX-License-Identifier: BSD-3-Clause
// Numbers from a user's file, by which atoms can be coloured.
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

/// A residue as files of numbers name it.
struct ResidueName {
  std::string chain;
  std::int32_t number = 0;
  char insertion_code = ' ';
  auto operator<=>(const ResidueName&) const = default;
};

/// A file of numbers: one an atom in order, or by atom, or by residue, or tables of these for frames of a run; only one
/// of the four is filled. NaN: missing.
struct NumberFile {
  std::string path;
  std::vector<double> numbers{};              ///< in the order of atoms
  std::map<std::uint32_t, double> by_atom{};  ///< by place in the molecule's file, from 0
  std::map<ResidueName, double> by_residue{};
  bool without_chains = false;  ///< by_residue names no chains: the molecule has one
  std::string column{};         ///< whose numbers these are; empty if columns have no names
  bool of_colors = false;       ///< numbers are colours, 0xrrggbb
  /// By number of the frame in its trajectory: that frame's numbers, by atom or by residue. Nothing: they are the same
  /// in all frames.
  std::shared_ptr<const std::map<std::uint64_t, NumberFile>> by_frame{};

  bool empty() const { return numbers.empty() && by_atom.empty() && by_residue.empty() && !by_frame; }

  /// The numbers that hold in a frame; nothing: that of a structure which is no frame of a run. Throws InputError where
  /// there are none of it.
  const NumberFile& of_frame(const std::optional<std::uint64_t>& frame) const;
  /// The least and the greatest number of all frames, by which a colour means the same in each of them; nothing where
  /// all are missing or none are by frame.
  std::optional<std::array<double, 2>> range_of_frames() const;
};

/// What messages say of the layouts of read_number_file.
inline constexpr const char* kNumberLayouts =
    "write one number for each atom of the file or each atom used; or lines of chain, residue and number, such as A 12 "
    "0.5; or a table with a header "
    "such as chain,resid,score, or resid,score for a molecule of one chain. Columns may be parted by commas, "
    "semicolons, tabs or blanks";

/// Reads one of three layouts; nan, ? and - stand for a missing number, # begins a comment:
/// - numbers between blanks, commas and line ends, one an atom;
/// - lines of chain, number of the residue with its insertion code (52A), and value, where the first chain is no
/// number;
/// - a table with a header, as `meniscus surface --csv` and `--csv-residues` write it: by its column "index", else by
///   "chain", "number" (or "resid", "resi", "position", ...) and, if there, "icode"; without "chain" for molecules of
///   one chain. `column` names the one of the numbers; it may be left out where there is one beside these, or none but
///   one with a usual name, such as "class" or "radius". With a column "frame" rows are of that frame of a run. A
///   column may have colours (#rrggbb) instead of numbers.
/// Columns of the last two are parted by tabs, semicolons, commas or blanks, the first of these that the first line
/// has; there numbers may have a decimal comma where it parts no columns, and empty cells, NA and N/A are missing, too.
/// Throws InputError naming the line, the word and what is wanted; see also read_text_file.
NumberFile read_number_file(const std::string& path, const std::string& column = {});

}  // namespace meniscus
