// SPDX-License-Identifier: BSD-3-Clause
// The numbers atoms are coloured by, and the colours that they have.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_schemes.h"

namespace meniscus {

/// The numbers atoms are coloured by, and how.
struct ColorScale {
  std::string title;  ///< "B-factor", "hydrophobicity (Kyte & Doolittle 1982)", ...
  std::string unit;   ///< "Å²", "e", or empty
  ColorMap map = ColorMap::viridis;
  std::shared_ptr<const ColorRamp> own_map;  ///< instead of `map`, if there is one
  std::array<double, 2> range{0.0, 1.0};     ///< at the ends of the map; equal if all numbers are
  std::vector<double> classes;               ///< categorical map only: the different numbers, ascending
  glm::vec3 missing_color{0.5f};
  std::size_t missing = 0;    ///< atoms without a number
  std::vector<double> value;  ///< per atom of the structure; NaN: missing

  /// sRGB. Beyond the range: the colour of its end. All numbers equal: the middle of the map. NaN: missing_color.
  glm::vec3 color(double number) const;
  /// How many colours there are, where these are steps; 0: they run into each other.
  std::size_t steps() const { return own_map ? 0 : map_steps(map); }
};

}  // namespace meniscus
