// SPDX-License-Identifier: BSD-3-Clause
// Parsing of number files, and the hydropathy table.
#include "core/structure/atom_numbers.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/text/parse_number.h"
#include "core/text/text_file.h"

namespace meniscus {
namespace {

/// Differences of such numbers are finite, which scales of colours rely on.
constexpr double kLargestNumber = 1e300;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct Hydropathy {
  double value;
  std::string_view names;
};

constexpr Hydropathy kKyteDoolittle[] = {{4.5, " ILE "},         {4.2, " VAL "},
                                         {3.8, " LEU "},         {2.8, " PHE "},
                                         {2.5, " CYS CYX CYM "}, {1.9, " MET MSE "},
                                         {1.8, " ALA "},         {-0.4, " GLY "},
                                         {-0.7, " THR "},        {-0.8, " SER "},
                                         {-0.9, " TRP "},        {-1.3, " TYR "},
                                         {-1.6, " PRO "},        {-3.2, " HIS HID HIE HIP HSD HSE HSP "},
                                         {-3.5, " GLU GLH "},    {-3.5, " GLN "},
                                         {-3.5, " ASP ASH "},    {-3.5, " ASN "},
                                         {-3.9, " LYS LYN "},    {-4.5, " ARG "}};

double parse_word(const std::string& path, std::size_t line, std::string_view word) {
  if (word == "nan" || word == "NaN" || word == "?" || word == "-") return kMissing;
  double number = 0.0;
  if (!parse_number(word, number) || std::abs(number) > kLargestNumber) {
    throw InputError(path, line,
                     fmt::format("{} is not a finite number; write one number an atom, nan, ? or - for a missing one",
                                 in_quotes(word)));
  }
  return number;
}

}  // namespace

NumberFile read_number_file(const std::string& path) {
  constexpr std::string_view kBetween = " \t\r,;";
  const TextFile file = read_text_file(path);
  NumberFile result{path, {}};
  std::size_t line = 0;
  for (std::string_view rest = file.text; !rest.empty();) {
    ++line;
    const std::size_t end = rest.find('\n');
    std::string_view text = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    text = text.substr(0, text.find('#'));
    while (true) {
      const std::size_t first = text.find_first_not_of(kBetween);
      if (first == std::string_view::npos) break;
      text.remove_prefix(first);
      const std::string_view word = text.substr(0, text.find_first_of(kBetween));
      result.numbers.push_back(parse_word(path, line, word));
      text.remove_prefix(word.size());
    }
  }
  if (result.numbers.empty()) throw InputError(path, 0, "holds no numbers; write one an atom");
  return result;
}

double hydropathy(std::string_view residue_name) {
  if (residue_name.empty()) return kMissing;
  const std::string word = fmt::format(" {} ", residue_name);
  for (const Hydropathy& entry : kKyteDoolittle) {
    if (entry.names.find(word) != std::string_view::npos) return entry.value;
  }
  return kMissing;
}

}  // namespace meniscus
