// SPDX-License-Identifier: BSD-3-Clause
// Reads files of numbers by which atoms can be coloured.
#include "core/structure/atom_numbers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// Differences of such numbers are finite, which scales of colours rely on.
constexpr double kLargestNumber = 1e300;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool is_missing(std::string_view word) { return word == "nan" || word == "NaN" || word == "?" || word == "-"; }

double parse_word(const std::string& path, std::size_t line, std::string_view word) {
  if (is_missing(word)) return kMissing;
  double number = 0.0;
  if (!parse_number(word, number) || std::abs(number) > kLargestNumber) {
    throw InputError(
        path, line,
        fmt::format("{} is not a finite number; write one number for each atom, with nan, ? or - for a missing one",
                    in_quotes(word)));
  }
  return number;
}

class NumberReader {
 public:
  NumberReader(const TextFile& file, const std::string& column)
      : column_(column), lines_(file.text), result_{.path = file.path} {}

  NumberFile read() {
    std::string_view line;
    bool first = true;
    while (lines_.next(line)) {
      const std::string_view text = trimmed(line.substr(0, line.find('#')));
      if (text.empty()) continue;
      if (first && begins_table(text)) {
        read_table(csv_cells_of(text));
        return std::move(result_);
      }
      if (!column_.empty())
        fail(fmt::format("is not the header of a table, so --color-column {} cannot choose a column",
                         in_quotes(column_)));
      const std::vector<std::string_view> fields = fields_of(text);
      if (first && names_residues(fields)) {
        by_residue_ = true;
        first = false;
        if (fields[2] == "value") continue;
      }
      first = false;
      if (by_residue_)
        add_residue(fields);
      else
        add_numbers(text);
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(result_.path, lines_.number(), what); }

  static bool is_number(std::string_view word) {
    double number = 0.0;
    return is_missing(word) || parse_number(word, number);
  }

  /// Commas and no number.
  static bool begins_table(std::string_view text) {
    if (text.find(',') == std::string_view::npos) return false;
    for (const std::string& cell : csv_cells_of(text))
      if (is_number(cell)) return false;
    return true;
  }

  /// "A 12 0.5", or the header "chain resid value".
  static bool names_residues(const std::vector<std::string_view>& fields) {
    if (fields.size() != 3) return false;
    ResidueName residue;
    return !is_number(fields[0]) && (fields[2] == "value" || (parse_place(fields[1], residue) && is_number(fields[2])));
  }

  /// "12", "-3", "52A".
  static bool parse_place(std::string_view word, ResidueName& residue) {
    residue.insertion_code = ' ';
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

  void add(NumberFile& to, const ResidueName& residue, double number) {
    if (!to.by_residue.emplace(residue, number).second)
      fail(fmt::format("gives residue {} of chain {} a second number", residue.number, in_quotes(residue.chain)));
  }

  void add_residue(const std::vector<std::string_view>& fields) {
    ResidueName residue;
    if (fields.size() != 3 || !parse_place(fields[1], residue))
      fail("should be a chain, the number of a residue and a value, as in A 12 0.5");
    residue.chain = std::string(fields[0]);
    add(result_, residue, parse_word(result_.path, lines_.number(), fields[2]));
  }

  void add_numbers(std::string_view text) {
    constexpr std::string_view kBetween = " \t,;";
    while (true) {
      const std::size_t first = text.find_first_not_of(kBetween);
      if (first == std::string_view::npos) return;
      text.remove_prefix(first);
      const std::string_view word = text.substr(0, text.find_first_of(kBetween));
      result_.numbers.push_back(parse_word(result_.path, lines_.number(), word));
      text.remove_prefix(word.size());
    }
  }

  /// The column of the numbers: the one asked for, or the only one that is not a name of an atom or residue.
  std::size_t value_column(const std::vector<std::string>& header) const {
    constexpr std::string_view kNames[] = {"frame", "index", "model", "chain",   "residue", "resname", "number",
                                           "resid", "icode", "name",  "element", "class",   "radius",  "atoms"};
    std::vector<std::string> others;
    for (const std::string& cell : header)
      if (std::ranges::find(kNames, cell) == std::end(kNames)) others.push_back(cell);
    if (column_.empty() && others.size() == 1)
      return static_cast<std::size_t>(std::ranges::find(header, others[0]) - header.begin());
    const auto found = std::ranges::find(header, column_);
    if (!column_.empty() && found != header.end()) return static_cast<std::size_t>(found - header.begin());
    std::string list;
    for (const std::string& name : others) list += (list.empty() ? "" : ", ") + escaped(name);
    fail(column_.empty() ? fmt::format("is a table; choose one of its columns by --color-column: {}", list)
                         : fmt::format("has no column {}; it has {}", in_quotes(column_), list));
  }

  void read_table(const std::vector<std::string>& header) {
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const auto place = [&](std::string_view name) {
      const auto found = std::ranges::find(header, name);
      return found == header.end() ? kNone : static_cast<std::size_t>(found - header.begin());
    };
    const std::size_t value = value_column(header), frame = place("frame"), index = place("index"),
                      chain = place("chain"), icode = place("icode"),
                      resid = place("number") == kNone ? place("resid") : place("number");
    result_.column = header[value];
    if (index == kNone && (chain == kNone || resid == kNone))
      fail("is the header of a table that does not identify its atoms; add a column index, or chain and number");
    std::map<std::uint64_t, NumberFile> frames;
    std::string_view line;
    while (lines_.next(line)) {
      if (trimmed(line).empty()) continue;
      const std::vector<std::string> cells = csv_cells_of(line);
      if (cells.size() != header.size()) fail(fmt::format("has {} cells, the header {}", cells.size(), header.size()));
      const double number = parse_word(result_.path, lines_.number(), cells[value]);
      NumberFile* to = &result_;
      if (frame != kNone) {
        std::int64_t place_in_run = -1;
        if (!parse_whole_number(cells[frame], place_in_run) || place_in_run < 0)
          fail(fmt::format("{} is not a frame number; frames count from 0", in_quotes(cells[frame])));
        to = &frames
                  .try_emplace(static_cast<std::uint64_t>(place_in_run),
                               NumberFile{.path = result_.path, .column = result_.column})
                  .first->second;
      }
      if (index != kNone) {
        std::int64_t atom = -1;
        if (!parse_whole_number(cells[index], atom) || atom != static_cast<std::uint32_t>(atom))
          fail(fmt::format("{} is not an atom index", in_quotes(cells[index])));
        if (!to->by_atom.emplace(static_cast<std::uint32_t>(atom), number).second)
          fail(fmt::format("gives atom {} a second number", atom));
        continue;
      }
      ResidueName residue;
      if (!parse_place(cells[resid], residue)) fail(fmt::format("{} is not a residue number", in_quotes(cells[resid])));
      residue.chain = cells[chain];
      if (icode != kNone && cells[icode].size() == 1) residue.insertion_code = cells[icode][0];
      add(*to, residue, number);
    }
    if (!frames.empty())
      result_.by_frame = std::make_shared<const std::map<std::uint64_t, NumberFile>>(std::move(frames));
  }

  const std::string& column_;
  LineReader lines_;
  NumberFile result_;
  bool by_residue_ = false;
};

}  // namespace

NumberFile read_number_file(const std::string& path, const std::string& column) {
  const TextFile file = read_text_file(path);
  NumberFile result = NumberReader(file, column).read();
  if (result.empty())
    throw InputError(path, 0, "holds no numbers; write one for each atom, or chain, residue and number");
  return result;
}

const NumberFile& NumberFile::of_frame(const std::optional<std::uint64_t>& frame) const {
  if (!by_frame) return *this;
  const std::string held = fmt::format("holds numbers of {} frames, {} to {}", by_frame->size(),
                                       by_frame->begin()->first, by_frame->rbegin()->first);
  if (!frame) throw InputError(path, 0, held + "; add --frames, or leave out its column frame");
  const auto found = by_frame->find(*frame);
  if (found == by_frame->end()) throw InputError(path, 0, fmt::format("{}, but none of frame {}", held, *frame));
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
