// SPDX-License-Identifier: BSD-3-Clause
// Colours by name: of elements, residue types and classes, and those of CSS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace meniscus {

/// 0xrrggbb as sRGB in [0, 1].
constexpr glm::vec3 color_from_hex(std::uint32_t hex) {
  return {static_cast<float>(hex >> 16 & 0xff) / 255.0f, static_cast<float>(hex >> 8 & 0xff) / 255.0f,
          static_cast<float>(hex & 0xff) / 255.0f};
}

/// So many colours differ; categorical_color() begins again after them.
inline constexpr std::size_t kCategoricalCount = 21;

/// The n-th class: M. Okabe and K. Ito, "Color Universal Design" (2008), distinguished with any colour vision. Black is
/// left out, it hides the shape. Beyond seven come the same hues paler, then darker.
glm::vec3 categorical_color(std::size_t n);

/// After the space-filling models of R. B. Corey, L. Pauling and W. L. Koltun, by atomic number; 0: unknown.
glm::vec3 cpk_color(std::uint8_t element);

/// The same hues paler, carbon #c8c8c8: dark on white they would hide shade and lines.
glm::vec3 element_color(std::uint8_t element);

/// One group of residue types: "acidic", ..., "adenine", ..., "other".
struct ResidueGroup {
  std::uint32_t color;
  std::string_view name;
  std::string_view members;  ///< " ASP GLU ASH GLH ", each between blanks
};

/// The group of a residue name; force-field names of charge states go with their parent.
const ResidueGroup& residue_group(const std::string& residue_name);

/// Convex, toroidal, concave.
inline constexpr std::array<glm::vec3, 3> kPatchKindColors{color_from_hex(0x009e73), color_from_hex(0x56b4e9),
                                                           color_from_hex(0xd55e00)};

/// Reads "#rrggbb", "#rgb" for the same with each digit twice, and the 148 names of CSS Color Module Level 4 (W3C),
/// section 6.1, in small letters: "red", "slategrey", ...; nothing for any other text. sRGB in [0, 1].
std::optional<glm::vec3> parse_color(std::string_view text);

/// "#rrggbb" of an sRGB colour in [0, 1].
std::string hex_color(const glm::vec3& color);

}  // namespace meniscus
