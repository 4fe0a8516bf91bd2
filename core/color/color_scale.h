// SPDX-License-Identifier: BSD-3-Clause
// The numbers that atoms or a volume map have, and the colours of these numbers.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_schemes.h"
#include "core/volume/volume_grid.h"

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

/// The map, where it is sampled, and what colours its values have.
struct VolumePaint {
  VolumeGrid grid;
  ColorScale scale;     ///< without numbers of atoms
  double offset = 0.0;  ///< Å outside of the surface, along its normal

  /// NaN where the map does not reach. point: Å; normal: of length 1, towards the solvent.
  double value(const glm::dvec3& point, const glm::dvec3& normal) const { return grid.sample(point + offset * normal); }
  /// sRGB.
  glm::vec3 color(const glm::dvec3& point, const glm::dvec3& normal) const { return scale.color(value(point, normal)); }
};

}  // namespace meniscus
