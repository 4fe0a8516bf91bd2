// SPDX-License-Identifier: BSD-3-Clause
// sRGB (IEC 61966-2-1): conversion to and from linear light, display colours of linear pixels, and the profile in
// pictures; and linear light with other primaries.
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

/// Converts one channel in [0, 1] from sRGB to linear light; the next function converts back.
float linear_from_srgb(float value);
float srgb_from_linear(float value);

inline glm::vec3 linear_from_srgb(const glm::vec3& c) {
  return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
}
inline glm::vec3 srgb_from_linear(const glm::vec3& c) {
  return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)};
}

/// Primaries and white point of linear light.
enum class Primaries {
  rec709,  ///< ITU-R BT.709, as in sRGB
  ap1      ///< ACEScg (Academy S-2014-004)
};

/// Returns x and y of red, green, blue and white.
const std::array<float, 8>& chromaticities(Primaries primaries);

/// Converts a linear colour of Rec. 709, possibly premultiplied, to other primaries.
glm::vec3 from_rec709(const glm::vec3& color, Primaries primaries);

/// Composes a linear, premultiplied pixel over an sRGB background, if there is one (then alpha is 1).
glm::vec4 over(const glm::vec4& front, const std::optional<glm::vec3>& background);

/// Returns the composed pixel in sRGB, not premultiplied, as in PNG.
glm::vec4 display_color(const glm::vec4& pixel, const std::optional<glm::vec3>& background);

/// Returns the stored value of a transparent pixel for programs that blend in sRGB, as nearly all layout programs do.
/// Over white they show display_color(), and over black too if the colour is grey; over other backgrounds a colour in
/// between.
glm::vec4 layout_color(const glm::vec4& pixel);

/// Converts a channel in [0, 1] to the nearest byte, 0 to 255, as in PNG files.
std::uint8_t display_byte(float channel);

/// Writes the bytes of display_color() of pixels, with or without alpha: 4 or 3 channels. It uses a table instead of
/// powers.
void display_bytes(std::span<const glm::vec4> pixels, const std::optional<glm::vec3>& background, std::size_t channels,
                   std::uint8_t* bytes);

/// Writes the four bytes of layout_color() of each pixel.
void layout_bytes(std::span<const glm::vec4> pixels, std::uint8_t* bytes);

/// Returns a display profile of version 4.3 (ISO 15076-1:2010): the primaries of IEC 61966-2-1 adapted to D50
/// (Bradford) and its transfer function as a parametric curve. The bytes are the same each time.
const std::vector<std::uint8_t>& srgb_profile();

}  // namespace meniscus
