// SPDX-License-Identifier: BSD-3-Clause
// Names and numbers of atom records (wwPDB format 3.3, and what molecular dynamics programs made of it).
#include "core/structure/formats/pdb_columns.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "core/structure/atom_classes.h"
#include "core/text/parse_number.h"
#include "core/structure/residue_names.h"
#include "core/text/text_lines.h"

namespace meniscus {
namespace {

/// Columns from..to, counted from 1 as the format's description does.
std::string_view columns(std::string_view line, std::size_t from, std::size_t to) {
  return line.size() < from ? std::string_view() : line.substr(from - 1, to + 1 - from);
}

char column(std::string_view line, std::size_t at) {
  const std::string_view text = columns(line, at, at);
  return text.empty() || text[0] == '\t' ? ' ' : text[0];
}

bool all_digits(std::string_view text) { return text.find_first_not_of("0123456789") == std::string_view::npos; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> in_base(std::string_view text, int base) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

/// Four characters: A000 to ZZZZ follow 9999, then a000 to zzzz.
std::optional<std::int64_t> hybrid_36(std::string_view field) {
  constexpr std::int64_t kCube = 36 * 36 * 36;
  if (field.size() != 4) return std::nullopt;
  const bool upper = field[0] >= 'A' && field[0] <= 'Z';
  const bool lower = field[0] >= 'a' && field[0] <= 'z';
  if (!upper && !lower) return std::nullopt;
  const auto other_case = [&](unsigned char c) { return upper ? std::islower(c) != 0 : std::isupper(c) != 0; };
  if (std::any_of(field.begin(), field.end(), other_case)) return std::nullopt;
  const std::optional<std::int64_t> number = in_base(field, 36);
  if (!number) return std::nullopt;
  return *number - 10 * kCube + 10000 + (lower ? 26 * kCube : 0);
}

/// Residue names of four letters (TIP3, POPC) reach into column 21, the first one of chain names of two letters.
bool has_name_of_four(std::string_view line, char column_21, char column_22, const std::string& segment) {
  if (column_21 == ' ') return false;
  if (column_22 == ' ' || !segment.empty()) return true;
  const std::string three(trimmed(columns(line, 18, 20)));
  return three.size() == 3 && (is_water_name(std::string(columns(line, 18, 21))) || !is_tabulated_residue(three));
}

}  // namespace

bool is_pdb_record(std::string_view line, std::string_view record) {
  if (line.size() < record.size() || (line.size() > record.size() && record.size() < 6 && line[record.size()] != ' '))
    return false;
  return std::equal(record.begin(), record.end(), line.begin(),
                    [](char r, char c) { return r == std::toupper(static_cast<unsigned char>(c)); });
}

bool is_pdb_atom(std::string_view line) { return is_pdb_record(line, "ATOM") || is_pdb_record(line, "HETATM"); }

void read_pdb_names(std::string_view line, Atom& atom) {
  atom.name = trimmed(columns(line, 13, 16));
  atom.altloc = column(line, 17);
  atom.segment = trimmed(columns(line, 73, 76));
  const bool four = has_name_of_four(line, column(line, 21), column(line, 22), atom.segment);
  atom.residue_name = trimmed(columns(line, 18, four ? 21 : 20));
  atom.chain = trimmed(columns(line, four ? 22 : 21, 22));
  if (atom.chain.empty()) atom.chain = atom.segment;
  atom.subchain = atom.chain;
  atom.insertion_code = column(line, 27);
}

bool PdbResidueNumbers::read(std::string_view line, Atom& atom) {
  const std::string_view field = trimmed(columns(line, 23, 26));
  std::int64_t number = 0;
  const bool decimal = parse_whole_number(field, number);
  const std::optional<std::int64_t> hybrid = hybrid_36(field);
  const std::optional<std::int64_t> hexadecimal = in_base(field, 16);
  const auto continues_count = [&](std::int64_t n) { return last_ >= 9999 && (n == last_ || n == last_ + 1); };
  if (decimal && field.size() == 4 && all_digits(field) && is_digit(atom.insertion_code)) {
    number = number * 10 + (atom.insertion_code - '0');
    atom.insertion_code = ' ';
  } else if (hexadecimal && *hexadecimal > 9999 && (continues_count(*hexadecimal) || !(decimal || hybrid))) {
    number = *hexadecimal;
  } else if (hybrid) {
    number = *hybrid;
  } else if (!decimal) {
    atom.residue_number = static_cast<std::int32_t>(field.empty() ? 0 : count_on(atom));
    return false;
  }
  atom.residue_number = static_cast<std::int32_t>(last_ = number);
  counted_names_.clear();
  counted_residue_.clear();
  return true;
}

std::int64_t PdbResidueNumbers::count_on(const Atom& atom) {
  const std::string name = atom.name + atom.altloc;
  const bool again = std::find(counted_names_.begin(), counted_names_.end(), name) != counted_names_.end();
  const std::string residue = atom.chain + '\n' + atom.residue_name;
  if (again || residue != counted_residue_) {
    ++last_;
    counted_names_.clear();
    counted_residue_ = residue;
  }
  counted_names_.push_back(name);
  return last_;
}

}  // namespace meniscus
