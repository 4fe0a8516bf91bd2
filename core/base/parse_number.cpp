// SPDX-License-Identifier: BSD-3-Clause
// Parses numbers that fill their field, and says what is wrong with others.
#include "core/base/parse_number.h"

#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

std::string_view without_plus(std::string_view field) {
  field = trimmed(field);
  if (field.size() > 1 && field.front() == '+' && field[1] != '-') field.remove_prefix(1);
  return field;
}

}  // namespace

bool parse_number(std::string_view field, double& number) {
  field = without_plus(field);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  return error == std::errc() && end == field.data() + field.size() && std::isfinite(number);
}

bool parse_single(std::string_view field, float& number) {
  double value = 0.0;
  if (!parse_number(field, value) || std::abs(value) > std::numeric_limits<float>::max()) return false;
  number = static_cast<float>(value);
  return true;
}

bool parse_whole_number(std::string_view field, std::int64_t& number) {
  field = without_plus(field);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  return error == std::errc() && end == field.data() + field.size();
}

double check_extent(const TextFile& file, std::size_t line, char axis, double coordinate) {
  if (std::abs(coordinate) > kLargestCoordinate) {
    throw InputError(file.path, line,
                     fmt::format("coordinate {} is {} Å, beyond the extent of ±{} Å; is the unit right?", axis,
                                 coordinate, kLargestCoordinate));
  }
  return coordinate;
}

void refuse_short_frame(const TextFile& file, std::size_t line, std::size_t count, std::size_t found) {
  throw InputError(file.path, line,
                   fmt::format("the count says {} atoms, but the file ends after {} of them; is it cut short?",
                               with_thousands(count), with_thousands(found)));
}

double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field) {
  double number = 0.0;
  if (!parse_number(field, number)) {
    throw InputError(
        file.path, line,
        fmt::format("coordinate {} is {}, not a finite number; correct or remove the atom", axis, in_quotes(field)));
  }
  return check_extent(file, line, axis, number);
}

bool try_parse_coordinate(std::string_view field, double unit, double& coordinate) {
  if (!parse_number(field, coordinate)) return false;
  coordinate *= unit;
  return std::abs(coordinate) <= kLargestCoordinate;
}

double parse_radius(const TextFile& file, std::size_t line, std::string_view field, std::string_view columns) {
  double radius = 0.0;
  if (!parse_number(field, radius)) {
    throw InputError(
        file.path, line,
        fmt::format("radius is {}, not a finite number; the expected line is: {}", in_quotes(field), columns));
  }
  if (radius < 0.0) throw InputError(file.path, line, fmt::format("radius is {} Å; it must not be negative", radius));
  if (radius > kLargestRadius) {
    throw InputError(
        file.path, line,
        fmt::format("radius is {} Å, above the limit of {} Å; is the unit right?", radius, kLargestRadius));
  }
  return radius;
}

}  // namespace meniscus
