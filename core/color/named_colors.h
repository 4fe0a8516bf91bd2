// SPDX-License-Identifier: BSD-3-Clause
// Colours by name: of elements, residue types and classes, and the names of CSS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace meniscus {

/// Converts 0xrrggbb to sRGB in [0, 1].
constexpr glm::vec3 color_from_hex(std::uint32_t hex) {
  return {static_cast<float>(hex >> 16 & 0xff) / 255.0f, static_cast<float>(hex >> 8 & 0xff) / 255.0f,
          static_cast<float>(hex & 0xff) / 255.0f};
}

/// The number of different colours of categorical_color(), which repeats after them.
inline constexpr std::size_t kCategoricalCount = 21;

/// Returns the colour of the n-th class: M. Okabe and K. Ito, "Color Universal Design" (2008), distinguished with any
/// colour vision. Black is left out, because it hides the shape. After seven come the same hues paler, then darker.
glm::vec3 categorical_color(std::size_t n);

/// Returns the colour of the n-th chain: ten pastel colours, which stay light under shade; then the same darker, then
/// paler; then all of them again.
glm::vec3 chain_color(std::size_t n);

/// Returns an element's colour in the space-filling models of R. B. Corey, L. Pauling and W. L. Koltun; 0: unknown.
glm::vec3 cpk_color(std::uint8_t element);

/// Returns the same hue paler, with carbon #c8c8c8: dark colours on white would hide shade and lines.
glm::vec3 element_color(std::uint8_t element);

/// One group of residue types: "acidic", ..., "adenine", ..., "other".
struct ResidueGroup {
  std::uint32_t color;
  std::string_view name;
  std::string_view members;  ///< " ASP GLU ASH GLH ", each between blanks
};

/// Returns the group of a residue name; force-field names of charge states belong to the group of their parent.
const ResidueGroup& residue_group(const std::string& residue_name);

/// The colours of convex, toroidal and concave patches.
inline constexpr std::array<glm::vec3, 3> kPatchKindColors{color_from_hex(0x009e73), color_from_hex(0x56b4e9),
                                                           color_from_hex(0xd55e00)};

/// Parses "#rrggbb", "#rgb" for the same with each digit twice, and the 148 names of CSS Color Module Level 4 (W3C),
/// section 6.1, in small letters: "red", "slategrey", ...; nothing for any other text. sRGB in [0, 1].
std::optional<glm::vec3> parse_color(std::string_view text);

/// Formats an sRGB colour in [0, 1] as "#rrggbb".
std::string hex_color(const glm::vec3& color);

}  // namespace meniscus
