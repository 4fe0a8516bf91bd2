// SPDX-License-Identifier: BSD-3-Clause
// Reads files with numbers for atoms or residues.
#include "core/structure/atom_numbers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// The largest number that is accepted. Differences of such numbers are finite, which colour scales rely on.
constexpr double kLargestNumber = 1e300;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool is_missing(std::string_view word) { return word == "nan" || word == "NaN" || word == "?" || word == "-"; }

/// True for a missing number, including the ways in which spreadsheets and R write it.
bool is_missing_cell(std::string_view cell) {
  return cell.empty() || cell == "NA" || cell == "N/A" || is_missing(cell);
}

bool is_number(std::string_view word) {
  double number = 0.0;
  return is_missing(word) || parse_number(word, number);
}

/// The columns of a table that have the numbers and identify the atoms.
struct Columns {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t value = kNone, frame = kNone, index = kNone, chain = kNone, residue = kNone, icode = kNone;
};

// The names of columns are in lower case.
constexpr std::string_view kChainNames[] = {"chain", "chain_id", "chainid", "auth_asym_id"};
// Tables that Meniscus writes call the type of a residue "residue" and its number "number".
constexpr std::string_view kResidueNames[] = {"number", "resid",    "resi", "resnum", "residue_number", "res_num",
                                              "resseq", "position", "pos",  "res_id", "auth_seq_id",    "residue"};
constexpr std::string_view kOtherNames[] = {"frame", "index", "model", "residue", "resname", "resn", "icode"};
// These columns of tables that Meniscus writes are used as numbers only if there are no others.
constexpr std::string_view kUsualNames[] = {"name", "atom", "element", "class", "radius", "atoms"};

/// True for a colour such as "#ff8000".
bool is_color(std::string_view word) {
  return word.size() == 7 && word[0] == '#' && word.find_first_not_of("0123456789abcdefABCDEF", 1) == word.npos;
}

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

class NumberReader {
 public:
  NumberReader(const TextFile& file, const std::string& column)
      : column_(column), lines_(file.text), result_{.path = file.path} {}

  NumberFile read() {
    std::string_view line;
    bool first = true;
    while (lines_.next(line)) {
      line = line.substr(0, line.find('#'));
      const std::string_view text = trimmed(line);
      if (text.empty()) continue;
      if (first) separator_ = separator_of(text);
      const std::vector<std::string> cells = cells_of(text);
      if (first && begins_table(cells)) {
        read_table(cells_of(line));
        return std::move(result_);
      }
      if (!column_.empty())
        fail(message("is not the header of a table, so @color-column {}@ cannot choose a column", in_quotes(column_)));
      if (first) is_by_residue_ = names_residue(cells);
      if (is_by_residue_)
        add_residue(cells);
      else
        add_numbers(text);
      first = false;
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(result_.path, lines_.number(), what); }

  /// Returns the separator of a table: the first of tab, semicolon and comma that its first line has, else a blank.
  static char separator_of(std::string_view text) {
    for (const char separator : {'\t', ';', ','})
      if (text.find(separator) != std::string_view::npos) return separator;
    return ' ';
  }

  std::vector<std::string> cells_of(std::string_view line) const {
    if (separator_ != ' ') return csv_cells_of(line, separator_);
    const std::vector<std::string_view> fields = fields_of(line);
    return {fields.begin(), fields.end()};
  }

  /// True for the header of a table: two words or more, none of them a number.
  static bool begins_table(const std::vector<std::string>& cells) {
    return cells.size() > 1 && std::ranges::none_of(cells, is_number);
  }

  /// True for a line such as "A 12 0.5".
  bool names_residue(const std::vector<std::string>& cells) const {
    ResidueName residue;
    return cells.size() == 3 && !is_number(cells[0]) && parse_place(cells[1], residue) &&
           (is_missing_cell(cells[2]) || is_number(with_point(cells[2])));
  }

  /// Returns the cell with a decimal point instead of a comma, unless commas separate columns.
  std::string with_point(std::string cell) const {
    if (separator_ != ',' && cell.find('.') == std::string::npos) std::ranges::replace(cell, ',', '.');
    return cell;
  }

  /// Parses the number of a residue: "12", "-3", "52A", or "12.0", as in a column of integers with missing ones.
  static bool parse_place(std::string_view word, ResidueName& residue) {
    residue.insertion_code = ' ';
    if (word.ends_with(".0")) word.remove_suffix(2);
    const char last = word.empty() ? ' ' : word.back();
    if ((last >= 'A' && last <= 'Z') || (last >= 'a' && last <= 'z')) {
      residue.insertion_code = last;
      word.remove_suffix(1);
    }
    std::int64_t number = 0;
    if (!parse_whole_number(word, number) || number != static_cast<std::int32_t>(number)) return false;
    residue.number = static_cast<std::int32_t>(number);
    return true;
  }

  double parse_word(std::string_view word) const {
    if (is_missing(word)) return kMissing;
    double number = 0.0;
    if (parse_number(word, number) && std::abs(number) <= kLargestNumber) return number;
    if (result_.empty()) fail(fmt::format("{} is not a finite number; {}", in_quotes(word), kNumberLayouts));
    fail(fmt::format("{} is not a finite number; write nan, ? or - for a missing one", in_quotes(word)));
  }

  double parse_cell(const std::string& cell) const {
    if (is_missing_cell(cell)) return kMissing;
    if (!result_.of_colors) return parse_word(with_point(cell));
    if (is_color(cell)) return static_cast<double>(std::stoul(cell.substr(1), nullptr, 16));
    fail(fmt::format("{} is not a colour such as #ff8000, which the first row has", in_quotes(cell)));
  }

  void add(NumberFile& to, const ResidueName& residue, double number) {
    if (to.by_residue.emplace(residue, number).second) return;
    fail(fmt::format("gives residue {}{} a second number", residue.number,
                     result_.without_chains ? "" : " of chain " + in_quotes(residue.chain)));
  }

  void add_residue(const std::vector<std::string>& cells) {
    ResidueName residue;
    if (cells.size() != 3 || !parse_place(cells[1], residue))
      fail("should be a chain, the number of a residue and a value, as in A 12 0.5");
    residue.chain = cells[0];
    add(result_, residue, parse_cell(cells[2]));
  }

  void add_numbers(std::string_view text) {
    constexpr std::string_view kBetween = " \t,;";
    while (true) {
      const std::size_t first = text.find_first_not_of(kBetween);
      if (first == std::string_view::npos) return;
      text.remove_prefix(first);
      const std::string_view word = text.substr(0, text.find_first_of(kBetween));
      result_.numbers.push_back(parse_word(word));
      text.remove_prefix(word.size());
    }
  }

  /// Returns the column of the numbers: the one with the requested name, or the only column of numbers that does not
  /// identify atoms or residues. first: the cells of the first row.
  std::size_t value_column(const std::vector<std::string>& header, const std::vector<std::string>& first) const {
    const auto found = std::ranges::find(header, column_);
    if (!column_.empty() && found != header.end()) return static_cast<std::size_t>(found - header.begin());
    std::vector<std::size_t> others, of_numbers, usual;
    for (std::size_t n = 0; n < header.size(); ++n) {
      const std::string name = lower_case(header[n]);
      if (name.empty() || is_one_of(kOtherNames, name) || is_one_of(kChainNames, name) ||
          is_one_of(kResidueNames, name))
        continue;
      const bool has_numbers =
          n < first.size() && (is_missing_cell(first[n]) || is_color(first[n]) || is_number(with_point(first[n])));
      const bool is_usual = is_one_of(kUsualNames, name);
      if (!is_usual) others.push_back(n);
      if (has_numbers) (is_usual ? usual : of_numbers).push_back(n);
    }
    if (of_numbers.empty()) of_numbers = usual;
    if (!of_numbers.empty()) others = of_numbers;
    if (column_.empty() && others.size() == 1) return others[0];
    if (others.empty()) fail(fmt::format("is the header of a table without a column of numbers; {}", kNumberLayouts));
    std::string list;
    for (const std::size_t n : others) list += (list.empty() ? "" : ", ") + escaped(header[n]);
    fail(column_.empty() ? message("is a table; choose one of its columns by @color-column@: {}", list)
                         : fmt::format("has no column {}; it has {}", in_quotes(column_), list));
  }

  /// Finds the columns of a table. first: the cells of the first row.
  Columns columns_of(const std::vector<std::string>& header, const std::vector<std::string>& first) const {
    const auto place = [&](std::span<const std::string_view> names) {
      for (const std::string_view name : names)
        for (std::size_t n = 0; n < header.size(); ++n)
          if (lower_case(header[n]) == name) return n;
      return Columns::kNone;
    };
    const auto place_of = [&](std::string_view name) { return place({&name, 1}); };
    Columns columns;
    columns.value = value_column(header, first);
    columns.frame = place_of("frame");
    columns.index = place_of("index");
    columns.chain = place(kChainNames);
    columns.residue = place(kResidueNames);
    columns.icode = place_of("icode");
    if (columns.index == Columns::kNone && columns.residue == Columns::kNone)
      fail(fmt::format("is the header of a table that does not identify its atoms; {}", kNumberLayouts));
    return columns;
  }

  /// Reads the next row of cells; false after the last one.
  bool next_row(std::vector<std::string>& cells) {
    std::string_view line;
    while (lines_.next(line)) {
      if (trimmed(line).empty()) continue;
      cells = cells_of(line);
      if (line.starts_with('#') && !(cells.size() > 1 && is_color(cells[0]))) continue;  // the line is a comment
      if (std::ranges::any_of(cells, [](const std::string& cell) { return !cell.empty(); })) return true;
    }
    return false;
  }

  void read_table(const std::vector<std::string>& header) {
    LineReader begin = lines_;
    std::vector<std::string> cells;
    next_row(cells);
    std::swap(lines_, begin);
    const Columns columns = columns_of(header, cells);
    result_.of_colors = columns.value < cells.size() && is_color(cells[columns.value]);
    if (header[columns.value] != "value") result_.column = header[columns.value];
    result_.without_chains = columns.index == Columns::kNone && columns.chain == Columns::kNone;
    std::map<std::uint64_t, NumberFile> frames;
    while (next_row(cells)) {
      if (cells.size() != header.size()) fail(fmt::format("has {} cells, the header {}", cells.size(), header.size()));
      NumberFile& to = columns.frame == Columns::kNone ? result_ : frame_of(cells[columns.frame], frames);
      const double number = parse_cell(cells[columns.value]);
      if (columns.index != Columns::kNone)
        add_atom(to, cells[columns.index], number);
      else
        add_row(to, cells, columns, number);
    }
    if (!frames.empty())
      result_.by_frame = std::make_shared<const std::map<std::uint64_t, NumberFile>>(std::move(frames));
  }

  NumberFile& frame_of(const std::string& cell, std::map<std::uint64_t, NumberFile>& frames) const {
    std::int64_t place_in_run = -1;
    if (!parse_whole_number(cell, place_in_run) || place_in_run < 0)
      fail(fmt::format("{} is not a frame number; frames count from 0", in_quotes(cell)));
    NumberFile empty{.path = result_.path,
                     .without_chains = result_.without_chains,
                     .column = result_.column,
                     .of_colors = result_.of_colors};
    return frames.try_emplace(static_cast<std::uint64_t>(place_in_run), std::move(empty)).first->second;
  }

  void add_atom(NumberFile& to, const std::string& cell, double number) const {
    std::int64_t atom = -1;
    if (!parse_whole_number(cell, atom) || atom != static_cast<std::uint32_t>(atom))
      fail(fmt::format("{} is not an atom index", in_quotes(cell)));
    if (!to.by_atom.emplace(static_cast<std::uint32_t>(atom), number).second)
      fail(fmt::format("gives atom {} a second number", atom));
  }

  void add_row(NumberFile& to, const std::vector<std::string>& cells, const Columns& columns, double number) {
    ResidueName residue;
    if (!parse_place(cells[columns.residue], residue))
      fail(fmt::format("{} is not a residue number", in_quotes(cells[columns.residue])));
    if (columns.chain != Columns::kNone) residue.chain = cells[columns.chain];
    if (columns.icode != Columns::kNone && cells[columns.icode].size() == 1)
      residue.insertion_code = cells[columns.icode][0];
    add(to, residue, number);
  }

  const std::string& column_;
  LineReader lines_;
  NumberFile result_;
  char separator_ = ' ';
  bool is_by_residue_ = false;
};

}  // namespace

NumberFile read_number_file(const std::string& path, const std::string& column) {
  const TextFile file = read_text_file(path);
  NumberFile result = NumberReader(file, column).read();
  if (result.empty()) throw InputError(path, 0, "holds no numbers; {}", kNumberLayouts);
  return result;
}

const NumberFile& NumberFile::of_frame(const std::optional<std::uint64_t>& frame) const {
  if (!by_frame) return *this;
  const std::string contents =
      fmt::format("holds numbers of {} {}, {} to {}", by_frame->size(), by_frame->size() == 1 ? "frame" : "frames",
                  by_frame->begin()->first, by_frame->rbegin()->first);
  if (!frame) throw InputError(path, 0, contents + message("; add @frames@, or leave out its column frame"));
  const auto found = by_frame->find(*frame);
  if (found == by_frame->end()) throw InputError(path, 0, "{}, but none of frame {}", contents, *frame);
  return found->second;
}

std::optional<std::array<double, 2>> NumberFile::range_of_frames() const {
  std::optional<std::array<double, 2>> range;
  const auto include = [&range](double number) {
    if (std::isnan(number)) return;
    if (!range) range = {number, number};
    range = {std::min((*range)[0], number), std::max((*range)[1], number)};
  };
  if (!by_frame) return range;
  for (const auto& [number, frame] : *by_frame) {
    for (const auto& [atom, value] : frame.by_atom) include(value);
    for (const auto& [residue, value] : frame.by_residue) include(value);
  }
  return range;
}

}  // namespace meniscus
