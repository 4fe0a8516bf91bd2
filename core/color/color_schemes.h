// SPDX-License-Identifier: BSD-3-Clause
// By what atoms are coloured: by what they are, by a number they have, or one colour for all.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/atom_numbers.h"
#include "core/color/color_maps.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// How much of what lies behind them some atoms cover.
struct OpacityRule {
  std::optional<Selection> atoms;  ///< nothing: all
  float opacity = 1.0f;            ///< in [0, 1]
};

/// A wish such as "chain" or "#e69f00".
struct ColorScheme {
  enum class By : std::uint8_t {
    element,
    chain,
    residue,    ///< type of residue, by chemistry
    copy,       ///< of an assembly made of atoms
    kind,       ///< of patch
    component,  ///< objects in turn: closed parts of the surface, chains, ...
    fixed,      ///< one colour
    bfactor,    ///< this one and those below are numbers, with a map and a range
    occupancy,
    charge,
    hydrophobicity,  ///< Kyte & Doolittle 1982
    index,           ///< place in the file
    file             ///< numbers of a file of the user's own
  };
  By by = By::element;
  glm::vec3 fixed{0.8f};                       ///< sRGB in [0, 1], for By::fixed
  std::optional<ColorMap> map;                 ///< nothing: that of the scheme (color_scale)
  std::optional<std::array<double, 2>> range;  ///< numbers at both ends of the map; nothing: automatic (color_scale)
  std::optional<glm::vec3> missing;            ///< of atoms without a number; nothing: default_missing_color
  NumberFile file;                             ///< for By::file
  std::vector<OpacityRule> opacities;          ///< of several that speak of an atom the last counts

  /// True for schemes that colour by a number.
  bool has_scale() const { return by >= By::bfactor; }
};

/// What a scheme is, in words users can look up.
struct ColorSchemeMetadata {
  std::string_view word;  ///< for --color
  ColorScheme::By by;
  std::string_view description;
  std::string_view source;  ///< of its colours or numbers; empty where it needs none
};

/// All schemes but the fixed colour, in the order the help names them.
std::span<const ColorSchemeMetadata> color_schemes();

/// Reads "element", ..., "file", "atom" (the same as "index") or "#rrggbb"; nothing for any other text.
std::optional<ColorScheme> parse_color_scheme(std::string_view text);

/// All words parse_color_scheme reads, for messages: "element, chain, ..., #rrggbb".
std::string color_scheme_words();

/// Reads "#rrggbb"; nothing for any other text.
std::optional<glm::vec3> parse_hex_color(std::string_view text);

/// Reads "EXPR=0.4", split at the last "=", or "0.4" for all atoms. Throws RequestError for a number outside [0, 1],
/// SelectionError.
OpacityRule parse_opacity_rule(std::string_view text);

/// Reads "lo:hi" with lo < hi and a finite difference; nothing for any other text.
std::optional<std::array<double, 2>> parse_color_range(std::string_view text);

/// The chain as the file names it: in an assembly copies of A are called, ... and keep its colour.
std::string chain_of_file(const Atom& atom);

}  // namespace meniscus
