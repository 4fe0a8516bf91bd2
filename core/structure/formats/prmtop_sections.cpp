// SPDX-License-Identifier: BSD-3-Clause
// Finds sections, and takes their fields off by columns: names may hold blanks, and fill theirs so that none is
// between.
#include "core/structure/formats/prmtop_sections.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// Takes the digits off the front of a text; 0 where there are none, or more than a line of text has columns.
std::size_t take_count(std::string_view& text) {
  std::size_t count = 0;
  while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front()))) {
    count = std::min<std::size_t>(10 * count + static_cast<std::size_t>(text.front() - '0'), 1'000'000);
    text.remove_prefix(1);
  }
  return count <= 1'000 ? count : 0;
}

}  // namespace

PrmtopSections::PrmtopSections(const TextFile& file) : file_(file) {
  LineReader lines(file.text);
  Section* section = nullptr;
  for (std::string_view line; lines.next(line);) {
    if (line.starts_with("%FLAG")) {
      std::string_view rest = line.substr(5);
      section = &sections_[std::string(take_field(rest))];
      *section = {};
      section->line = lines.number();
    } else if (section && line.starts_with("%FORMAT(")) {
      // As Fortran has it: 20a4, 10I8, 5E16.8.
      std::string_view columns = line.substr(8);
      section->per_line = take_count(columns);
      if (!columns.empty() && std::isalpha(static_cast<unsigned char>(columns.front()))) columns.remove_prefix(1);
      section->width = take_count(columns);
      section->first_line = lines.number() + 1;
      section->text = std::string_view(file.text).substr(file.text.size() - lines.bytes_left(), 0);
    } else if (section && section->first_line != 0 && !line.starts_with('%')) {
      section->text = {section->text.data(),
                       static_cast<std::size_t>(line.data() + line.size() - section->text.data())};
    }
  }
  if (sections_.empty())
    throw InputError(file.path, 0,
                     "has no %FLAG: prmtop files of Amber 6 and before are not read; write it anew, by ParmEd's "
                     "'outparm'");
}

const PrmtopSections::Section& PrmtopSections::find(std::string_view name) const {
  const auto found = sections_.find(name);
  if (found == sections_.end())
    throw InputError(file_.path, 0, fmt::format("has no section %FLAG {}; is the file cut short?", name));
  const Section& section = found->second;
  if (section.per_line == 0 || section.width == 0)
    throw InputError(file_.path, section.line,
                     fmt::format("%FLAG {} has no %FORMAT such as (20a4) or (5E16.8) behind it", name));
  return section;
}

void PrmtopSections::each_field(std::string_view name, std::size_t count, Fields kind, const Take& take) const {
  const Section& section = find(name);
  if (count > section.text.size())  // no field has less than one letter
    throw InputError(file_.path, section.line,
                     fmt::format("%FLAG {} should have {} fields, more than its {} bytes can hold; is the file cut "
                                 "short?",
                                 name, with_thousands(count), with_thousands(section.text.size())));
  LineReader lines(section.text);
  std::size_t taken = 0;
  for (std::string_view line; lines.next(line);) {
    for (std::size_t n = 0; n < section.per_line && taken < count; ++n, ++taken) {
      // A line may lack the blanks at its end, and with them names of blanks.
      if (kind != Fields::texts && trimmed(line).empty()) break;
      take(line.substr(0, section.width), section.first_line + lines.number() - 1);
      line.remove_prefix(std::min(line.size(), section.width));
    }
    if (kind != Fields::first_numbers && taken == count && !trimmed(line).empty())
      throw InputError(file_.path, section.first_line + lines.number() - 1,
                       fmt::format("%FLAG {} has {} behind its {} fields; are POINTERS those of another file?", name,
                                   in_quotes(trimmed(line)), with_thousands(count)));
  }
  if (taken < count)
    throw InputError(file_.path, section.line,
                     fmt::format("%FLAG {} should have {} fields, but {} follow; is the file cut short?", name,
                                 with_thousands(count), with_thousands(taken)));
}

std::vector<std::string> PrmtopSections::texts(std::string_view name, std::size_t count) const {
  std::vector<std::string> texts;
  each_field(name, count, Fields::texts,
             [&](std::string_view field, std::size_t) { texts.emplace_back(trimmed(field)); });
  return texts;
}

std::vector<double> PrmtopSections::numbers(std::string_view name, std::size_t count) const {
  std::vector<double> numbers;
  each_field(name, count, Fields::numbers, [&](std::string_view field, std::size_t line) {
    double number = 0.0;
    if (!parse_number(field, number))
      throw InputError(file_.path, line, fmt::format("{} of %FLAG {} is no number", in_quotes(field), name));
    numbers.push_back(number);
  });
  return numbers;
}

void PrmtopSections::take_number(std::string_view name, std::string_view field, std::size_t line,
                                 std::vector<std::int64_t>& numbers) const {
  std::int64_t number = 0;
  if (!parse_whole_number(field, number))
    throw InputError(file_.path, line, fmt::format("{} of %FLAG {} is no whole number", in_quotes(field), name));
  numbers.push_back(number);
}

std::vector<std::int64_t> PrmtopSections::whole_numbers(std::string_view name, std::size_t count, std::int64_t least,
                                                        std::int64_t most) const {
  std::vector<std::int64_t> numbers;
  each_field(name, count, Fields::numbers, [&](std::string_view field, std::size_t line) {
    take_number(name, field, line, numbers);
    if (numbers.back() < least || numbers.back() > most)
      throw InputError(file_.path, line,
                       fmt::format("%FLAG {} holds {}, which is not from {} to {}", name, numbers.back(), least, most));
  });
  return numbers;
}

std::vector<std::int64_t> PrmtopSections::first_whole_numbers(std::string_view name, std::size_t count) const {
  std::vector<std::int64_t> numbers;
  each_field(name, count, Fields::first_numbers,
             [&](std::string_view field, std::size_t line) { take_number(name, field, line, numbers); });
  return numbers;
}

}  // namespace meniscus
