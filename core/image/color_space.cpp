// SPDX-License-Identifier: BSD-3-Clause
// Converts between sRGB and linear light, and maps gathered light to colours that a screen can show.
#include "core/image/color_space.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace meniscus {

float linear_from_srgb(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

namespace {

/// Which linear values are shown as which byte.
class ByteSteps {
 public:
  ByteSteps() {
    for (std::size_t byte = 1; byte < least_.size(); ++byte) least_[byte] = least_shown_as(byte);
    for (std::size_t place = 0, byte = 0; place < first_.size(); ++place) {
      while (byte < 255 && least_[byte + 1] <= value_at(place)) ++byte;
      first_[place] = static_cast<std::uint8_t>(byte);
    }
  }

  /// display_byte(srgb_from_linear(value)).
  std::uint8_t byte_of(float value) const {
    if (!(value > 0.0f)) return 0;
    if (value >= 1.0f) return 255;
    std::size_t byte = first_[std::bit_cast<std::uint32_t>(value) >> kSkipped];
    while (byte < 255 && value >= least_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr int kSkipped = 16;  // bits of a float; the others leave two steps at most to be looked at

  static float value_at(std::size_t place) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(place << kSkipped));
  }

  /// By halving; floats above zero are ordered as their bits are.
  static float least_shown_as(std::size_t byte) {
    std::uint32_t below = 0, at = std::bit_cast<std::uint32_t>(1.0f);
    while (at - below > 1) {
      const std::uint32_t middle = below + (at - below) / 2;
      (display_byte(srgb_from_linear(std::bit_cast<float>(middle))) < byte ? below : at) = middle;
    }
    return std::bit_cast<float>(at);
  }

  std::array<float, 256> least_{};
  std::array<std::uint8_t, (0x3f800000u >> kSkipped) + 1> first_{};  // of the values up to 1 with these leading bits
};

}  // namespace

glm::vec4 over(const glm::vec4& front, const std::optional<glm::vec3>& background) {
  if (!background) return front;
  return {glm::vec3(front) + (1.0f - front.w) * linear_from_srgb(*background), 1.0f};
}

glm::vec4 display_color(const glm::vec4& pixel, const std::optional<glm::vec3>& background) {
  const glm::vec4 c = over(pixel, background);
  return {srgb_from_linear(c.w > 0.0f ? glm::vec3(c) / c.w : glm::vec3(0.0f)), c.w};
}

glm::vec4 layout_color(const glm::vec4& pixel) {
  if (pixel.w <= 0.0f || pixel.w >= 1.0f) return display_color(pixel, {});
  const glm::vec3 on_white = srgb_from_linear(glm::vec3(pixel) + (1.0f - pixel.w));
  const glm::vec3 on_black = srgb_from_linear(glm::vec3(pixel));
  // Of the backgrounds' difference this is left; where channels disagree, the least, which keeps colours in range.
  const glm::vec3 left = on_white - on_black;
  const float alpha = std::clamp(1.0f - std::min({left.x, left.y, left.z}), 0.0f, 1.0f);
  return {alpha > 0.0f ? (on_white - (1.0f - alpha)) / alpha : glm::vec3(0.0f), alpha};
}

std::uint8_t display_byte(float channel) {
  return static_cast<std::uint8_t>(std::clamp(channel * 255.0f, 0.0f, 255.0f) + 0.5f);
}

void display_bytes(std::span<const glm::vec4> pixels, const std::optional<glm::vec3>& background, std::size_t channels,
                   std::uint8_t* bytes) {
  static const ByteSteps steps;
  std::optional<glm::vec3> behind;
  if (background) behind = linear_from_srgb(*background);
  for (const glm::vec4& pixel : pixels) {
    const glm::vec3 light = behind ? glm::vec3(pixel) + (1.0f - pixel.w) * *behind
                                   : (pixel.w > 0.0f ? glm::vec3(pixel) / pixel.w : glm::vec3(0.0f));
    for (int channel = 0; channel < 3; ++channel) *bytes++ = steps.byte_of(light[channel]);
    if (channels == 4) *bytes++ = behind ? 255 : display_byte(pixel.w);
  }
}

void layout_bytes(std::span<const glm::vec4> pixels, std::uint8_t* bytes) {
  for (const glm::vec4& pixel : pixels) {
    if (pixel.w <= 0.0f || pixel.w >= 1.0f) {  // most are
      display_bytes({&pixel, 1}, {}, 4, bytes);
    } else {
      const glm::vec4 color = layout_color(pixel);
      for (int channel = 0; channel < 4; ++channel) bytes[channel] = display_byte(color[channel]);
    }
    bytes += 4;
  }
}

}  // namespace meniscus
