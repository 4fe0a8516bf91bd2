// SPDX-License-Identifier: BSD-3-Clause
// How atoms get their colours: by element, chain, residue, B-factor, order, patch kind, or one colour for all.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/molecule/structure.h"
#include "core/surface/coloring.h"

namespace meniscus {

/// A wish such as "chain" or "#e69f00".
struct ColorScheme {
  enum class By { element, chain, residue, bfactor, kind, atom, fixed };
  By by = By::element;
  glm::vec3 fixed{0.8f};                       ///< sRGB in [0, 1], for By::fixed
  std::optional<std::array<double, 2>> range;  ///< for By::bfactor: values at both ends of the map; else the data's
};

/// Reads "element", "chain", "residue", "bfactor", "kind", "atom" or "#rrggbb"; nothing for any other text.
std::optional<ColorScheme> parse_color_scheme(std::string_view text);

/// Reads "lo:hi" with lo < hi, both finite; nothing for any other text.
std::optional<std::array<double, 2>> parse_color_range(std::string_view text);

/// One colour an atom. Missing B-factors get kMissingValueColor.
/// Throws InputError when colours by B-factor are asked for and no atom has one.
Coloring color_atoms(const Structure& structure, const ColorScheme& scheme);

/// The viridis map at t in [0, 1] (clamped), sRGB.
glm::vec3 viridis(double t);

/// Corey-Pauling-Koltun-like colour of an element by atomic number.
glm::vec3 element_color(std::uint8_t element);

inline constexpr glm::vec3 kMissingValueColor{0.5f, 0.5f, 0.5f};

}  // namespace meniscus
