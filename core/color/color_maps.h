// SPDX-License-Identifier: BSD-3-Clause
// Colour maps that people with any colour vision can order, scales that map numbers to them, and volume maps that
// colour points of a surface by such a scale.
#pragma once

#include <memory>
#include <optional>

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
  pastel,
  categorical
};

/// The description of a map for users.
struct ColorMapMetadata {
  ColorMap map;
  std::string_view name;
  std::string_view source;                  ///< authors, year, licence
  std::span<const std::uint32_t> colors{};  ///< sRGB, 0xrrggbb, at even steps; the categorical map borrows another's
};

/// Returns all maps, in the order the help names them.
std::span<const ColorMapMetadata> color_maps();

/// Returns the name of a map: "viridis", ..., "blue-white-red", "categorical".
std::string_view map_name(ColorMap map);

/// Parses the name of a map; nothing for any other text.
std::optional<ColorMap> parse_color_map(std::string_view text);

/// Returns the colour at t in [0, 1] (clamped), sRGB; for a map of steps the colour with the nearest place. `map` must
/// not be the categorical map, which has no order.
glm::vec3 mapped_color(ColorMap map, double t);

/// Returns the number of colours of a map of steps, each for a class of numbers; 0 for a continuous map.
std::size_t map_steps(ColorMap map);

/// Returns the default colour of atoms without a number: grey #808080, which no map comes near; #cc79a7 with cividis,
/// which contains grey; and ConSurf's own yellow for grades with insufficient data.
glm::vec3 default_missing_color(ColorMap map);

/// Colours at ascending places, with straight lines in sRGB between them.
struct ColorRamp {
  std::vector<double> places;     ///< ascending, from 0 to 1
  std::vector<glm::vec3> colors;  ///< one for each place, at least two; sRGB

  /// Returns the colour at t in [0, 1] (clamped).
  glm::vec3 color(double t) const;
};

/// Reads a colour map: lines with a colour (#rrggbb, #rgb, a name of CSS), or with a place and a colour separated by
/// blanks or commas, where # and a blank begin a comment; or a JSON list of colours or of pairs [place, colour]. Places
/// are ascending numbers, which are scaled to [0, 1]. Throws InputError naming the line.
ColorRamp read_color_ramp(const std::string& path);

/// The numbers by which atoms are coloured, and their map.
struct ColorScale {
  std::string title;  ///< "B-factor", "hydrophobicity (Kyte & Doolittle 1982)", ...
  std::string unit;   ///< "Å²", "e", or empty
  ColorMap map = ColorMap::viridis;
  std::shared_ptr<const ColorRamp> own_map;  ///< replaces `map`, if set
  std::array<double, 2> range{0.0, 1.0};     ///< numbers at the ends of the map; equal if all numbers are equal
  std::array<std::string, 2> ends{};         ///< the meaning of the ends in words; empty: only their numbers
  std::vector<double> classes;               ///< categorical map and colours only: the different numbers, ascending
  bool of_colors = false;                    ///< true if numbers are colours, 0xrrggbb
  glm::vec3 missing_color{0.5f};
  std::size_t missing = 0;    ///< number of atoms without a number
  std::vector<double> value;  ///< per atom of the structure; NaN: missing

  /// Returns the colour of a number, sRGB. Beyond the range: the colour of its end. All numbers equal: the middle of
  /// the map. NaN: missing_color.
  glm::vec3 color(double number) const;
  /// Returns the number of colours of a map of steps; 0 for a continuous map.
  std::size_t steps() const { return own_map ? 0 : map_steps(map); }
};

/// A volume map, the distance at which it is sampled, and the colours of its values.
struct VolumePaint {
  VolumeGrid grid;
  ColorScale scale;     ///< has no numbers of atoms
  double offset = 0.0;  ///< Å outside of the surface, along its normal

  /// Returns the value at a point; NaN outside the map. point: Å; normal: of length 1, towards the solvent.
  double value(const glm::dvec3& point, const glm::dvec3& normal) const { return grid.sample(point + offset * normal); }
  /// Returns the colour at a point, sRGB.
  glm::vec3 color(const glm::dvec3& point, const glm::dvec3& normal) const { return scale.color(value(point, normal)); }
};

}  // namespace meniscus
