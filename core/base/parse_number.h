// SPDX-License-Identifier: BSD-3-Clause
// Numbers of molecule files, checked strictly: a reader that guesses at a coordinate draws a wrong surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/text_file.h"

namespace meniscus {

/// Throws InputError: the count in this line promises more atoms than the file holds.
[[noreturn]] void refuse_short_frame(const TextFile& file, std::size_t line, std::size_t count, std::size_t found);

/// Largest coordinate in Å that readers accept (10 µm); beyond it the file is broken or in other units.
inline constexpr double kLargestCoordinate = 1e5;

/// Checks a coordinate in Å that was written as `field`; throws InputError beyond kLargestCoordinate.
double check_extent(const TextFile& file, std::size_t line, char axis, double coordinate);

/// Parses a coordinate field; throws InputError naming file, line, axis and text unless finite and within bounds.
double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field);

/// Parses a coordinate field times `unit` (Å) as parse_coordinate does; false instead of an error.
bool parse_quickly(std::string_view field, double unit, double& coordinate);

/// Parses a radius field in Å; throws InputError unless it is a number from 0 to 1,000. `columns`: what a line holds.
double parse_radius(const TextFile& file, std::size_t line, std::string_view field, std::string_view columns);

/// Parses all of `field`, blanks around it aside, as a finite number; false if it is none.
bool parse_number(std::string_view field, double& number);

/// Parses all of `field`, blanks around it aside, as a whole number; false if it is none.
bool parse_whole_number(std::string_view field, std::int64_t& number);

/// Largest radius in Å that readers accept.
inline constexpr double kLargestRadius = 1000.0;

/// parse_number in single precision; false also beyond its range, where there is infinity only.
bool parse_single(std::string_view field, float& number);

}  // namespace meniscus
