// SPDX-License-Identifier: BSD-3-Clause
// Strict parsing of numbers in molecule files: a coordinate that is guessed would give a wrong surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/text_file.h"

namespace meniscus {

/// Throws InputError: the number of atoms in this line is larger than the number of atoms in the file.
[[noreturn]] void refuse_short_frame(const TextFile& file, std::size_t line, std::size_t count, std::size_t found);

/// The largest coordinate that readers accept, in Å (10 µm). A file with larger ones is broken or uses other units.
inline constexpr double kLargestCoordinate = 1e5;

/// Returns a coordinate in Å. Throws InputError if it is beyond kLargestCoordinate.
double check_extent(const TextFile& file, std::size_t line, char axis, double coordinate);

/// Parses a coordinate field in Å. Throws InputError with file, line, axis and text if it is not finite or beyond
/// kLargestCoordinate.
double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field);

/// Parses a coordinate field and multiplies it by `unit` (Å). False where parse_coordinate would throw.
bool try_parse_coordinate(std::string_view field, double unit, double& coordinate);

/// Parses a radius field in Å. Throws InputError if it is not a number from 0 to 1,000. columns: the fields of a line,
/// for messages.
double parse_radius(const TextFile& file, std::size_t line, std::string_view field, std::string_view columns);

/// Parses a field as a finite number. Blanks around the number are allowed. False if the field is anything else.
bool parse_number(std::string_view field, double& number);

/// Parses a field as a whole number. Blanks around the number are allowed. False if the field is anything else.
bool parse_whole_number(std::string_view field, std::int64_t& number);

/// The largest radius that readers accept, in Å.
inline constexpr double kLargestRadius = 1000.0;

/// Parses a field as parse_number does, and rounds to single precision. False also beyond the range of that.
bool parse_single(std::string_view field, float& number);

}  // namespace meniscus
