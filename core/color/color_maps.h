// SPDX-License-Identifier: BSD-3-Clause
// Colour maps that people with any colour vision can order, scales that map numbers to them, and volume maps that
// colour points of a surface by such a scale.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/volume/volume_grid.h"

namespace meniscus {

enum class ColorMap : std::uint8_t {
  viridis,
  cividis,
  magma,
  blue_white_red,
  red_white_blue,
  blues,
  ylorrd,
  consurf,
  rainbow,
  categorical
};

/// What a map is, in words users can look up.
struct ColorMapMetadata {
  ColorMap map;
  std::string_view name;
  std::string_view source;  ///< authors, year, licence
};

/// All maps, in the order the help names them.
std::span<const ColorMapMetadata> color_maps();

/// "viridis", ..., "blue-white-red", "categorical".
std::string_view map_name(ColorMap map);

/// The inverse; nothing for any other text.
std::optional<ColorMap> parse_color_map(std::string_view text);

/// The colour at t in [0, 1] (clamped), sRGB; of a map of steps the one whose place is nearest. Not for the categorical
/// map, which has no order.
glm::vec3 mapped_color(ColorMap map, double t);

/// How many colours a map of steps has, each of which stands for a class of numbers; 0: colours run into each other.
std::size_t map_steps(ColorMap map);

/// What atoms without a number get unless set otherwise: a grey #808080, which no map comes near, but #cc79a7 with
/// cividis, which goes through grey, and ConSurf's own yellow for grades of too few data.
glm::vec3 default_missing_color(ColorMap map);

/// Colours at rising places, straight lines in sRGB between them.
struct ColorRamp {
  std::vector<double> places;     ///< from 0 to 1, rising
  std::vector<glm::vec3> colors;  ///< as many, at least two; sRGB

  /// At t in [0, 1] (clamped).
  glm::vec3 color(double t) const;
};

/// Reads lines of a colour (#rrggbb, #rgb, a name of CSS), or of a place and a colour with blanks or commas between, #
/// and a blank begin a comment; or a JSON list of colours or of pairs [place, colour]. Places are any rising numbers;
/// they are stretched to [0, 1]. Throws InputError naming the line.
ColorRamp read_color_ramp(const std::string& path);

/// The numbers atoms are coloured by, and how.
struct ColorScale {
  std::string title;  ///< "B-factor", "hydrophobicity (Kyte & Doolittle 1982)", ...
  std::string unit;   ///< "Å²", "e", or empty
  ColorMap map = ColorMap::viridis;
  std::shared_ptr<const ColorRamp> own_map;  ///< instead of `map`, if there is one
  std::array<double, 2> range{0.0, 1.0};     ///< at the ends of the map; equal if all numbers are
  std::array<std::string, 2> ends{};         ///< what the ends mean, in words; empty: just their numbers
  std::vector<double> classes;               ///< categorical map and colours only: the different numbers, ascending
  bool of_colors = false;                    ///< numbers are colours, 0xrrggbb
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
