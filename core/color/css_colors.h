// SPDX-License-Identifier: BSD-3-Clause
// Colours as people write them: by the names that CSS has for them, or in hexadecimal digits.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace meniscus {

/// Reads "#rrggbb", or "#rgb" for the same with each digit twice; nothing for any other text. sRGB in [0, 1].
std::optional<glm::vec3> parse_hex_color(std::string_view text);

/// Reads these, and the 148 names in small letters of CSS Color Module Level 4 (W3C), section 6.1: "red", "slategrey",
/// ...; nothing for any other text.
std::optional<glm::vec3> parse_color(std::string_view text);

/// "#rrggbb" of an sRGB colour in [0, 1].
std::string hex_color(const glm::vec3& color);

}  // namespace meniscus
