// SPDX-License-Identifier: BSD-3-Clause
// Numbers of molecule files, checked strictly: a reader that guesses at a coordinate draws a wrong surface.
#include "core/molecule/reader.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

bool parse_number(std::string_view field, double& number) {
  const std::size_t first = field.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  field = field.substr(first, field.find_last_not_of(" \t") + 1 - first);
  if (field.size() > 1 && field.front() == '+' && field[1] != '-') field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  return error == std::errc() && end == field.data() + field.size() && std::isfinite(number);
}

double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field) {
  double number = 0.0;
  if (!parse_number(field, number)) {
    throw InputError(
        file.path, line,
        fmt::format("coordinate {} is {}, not a finite number; correct or remove the atom", axis, in_quotes(field)));
  }
  if (std::abs(number) > kLargestCoordinate) {
    throw InputError(file.path, line,
                     fmt::format("coordinate {} is {} Å, beyond the extent of ±{} Å; is the unit right?", axis, number,
                                 kLargestCoordinate));
  }
  return number;
}

}  // namespace meniscus
