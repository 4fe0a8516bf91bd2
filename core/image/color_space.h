// SPDX-License-Identifier: BSD-3-Clause
// sRGB (IEC 61966-2-1): conversion from and to linear light, screen colours of gathered light, and the profile that
// pictures carry; and linear light by other primaries.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus {

/// One channel in [0, 1] each way.
float linear_from_srgb(float value);
float srgb_from_linear(float value);

inline glm::vec3 linear_from_srgb(const glm::vec3& c) {
  return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
}
inline glm::vec3 srgb_from_linear(const glm::vec3& c) {
  return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)};
}

/// Primaries and white of linear light.
enum class Primaries {
  rec709,  ///< ITU-R BT.709, those of sRGB
  ap1      ///< ACEScg (Academy S-2014-004)
};

/// x and y of red, green, blue and white.
const std::array<float, 8>& chromaticities(Primaries primaries);

/// A linear colour of Rec. 709, perhaps premultiplied, by other primaries.
glm::vec3 from_rec709(const glm::vec3& color, Primaries primaries);

/// A linear pixel with its alpha multiplied in, before an sRGB background if there is one (alpha 1 then).
glm::vec4 over(const glm::vec4& front, const std::optional<glm::vec3>& background);

/// The same in sRGB, alpha not multiplied in, as PNG has it.
glm::vec4 display_color(const glm::vec4& pixel, const std::optional<glm::vec3>& background);

/// What a transparent pixel is stored as so that programs that blend in sRGB, as nearly all do that lay out pages, get
/// of it what display_color() has over white, and over black too if it is grey; on other backgrounds something between.
glm::vec4 layout_color(const glm::vec4& pixel);

/// A channel in [0, 1] as PNG files have it: 0 to 255, to the nearest.
std::uint8_t display_byte(float channel);

/// The bytes of display_color() of pixels, with or without the alpha: 3 or 4 channels. By a table instead of powers.
void display_bytes(std::span<const glm::vec4> pixels, const std::optional<glm::vec3>& background, std::size_t channels,
                   std::uint8_t* bytes);

/// The four bytes of layout_color() of each pixel.
void layout_bytes(std::span<const glm::vec4> pixels, std::uint8_t* bytes);

/// A display profile of version 4.3 (ISO 15076-1:2010): the primaries of IEC 61966-2-1 adapted to D50 (Bradford) and
/// its transfer function as a parametric curve. The same bytes each time.
const std::vector<std::uint8_t>& srgb_profile();

}  // namespace meniscus
