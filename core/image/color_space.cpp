// SPDX-License-Identifier: BSD-3-Clause
// Converts between sRGB and linear light, computes display colours, and writes the ICC profile.
#include "core/image/color_space.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <glm/mat3x3.hpp>

namespace meniscus {

float linear_from_srgb(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

const std::array<float, 8>& chromaticities(Primaries primaries) {
  static constexpr std::array<float, 8> kRec709{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f},
      kAp1{0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f};
  return primaries == Primaries::ap1 ? kAp1 : kRec709;
}

glm::vec3 from_rec709(const glm::vec3& color, Primaries primaries) {
  // This matrix follows from the chromaticities above and Lam & Rigg's "Bradford" adaptation from D65; OpenColorIO's
  // configurations for ACES have the same numbers. Columns are red, green and blue.
  static const glm::mat3 kAp1(0.6130974024f, 0.0701937225f, 0.0206155929f, 0.3395231462f, 0.9163538791f, 0.1095697729f,
                              0.0473794514f, 0.0134523985f, 0.8698146342f);
  return primaries == Primaries::ap1 ? kAp1 * color : color;
}

namespace {

/// A table of the linear values at which the displayed byte changes.
class ByteSteps {
 public:
  ByteSteps() {
    for (std::size_t byte = 1; byte < least_.size(); ++byte) least_[byte] = least_shown_as(byte);
    for (std::size_t place = 0, byte = 0; place < first_.size(); ++place) {
      while (byte < 255 && least_[byte + 1] <= value_at(place)) ++byte;
      first_[place] = static_cast<std::uint8_t>(byte);
    }
  }

  /// Returns display_byte(srgb_from_linear(value)).
  std::uint8_t byte_of(float value) const {
    if (!(value > 0.0f)) return 0;
    if (value >= 1.0f) return 255;
    std::size_t byte = first_[std::bit_cast<std::uint32_t>(value) >> kSkipped];
    while (byte < 255 && value >= least_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr int kSkipped =
      16;  // bits of a float without influence on the table; at most two steps remain to be compared

  static float value_at(std::size_t place) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(place << kSkipped));
  }

  /// Returns the smallest value shown as this byte, by bisection; floats above zero are ordered like their bits.
  static float least_shown_as(std::size_t byte) {
    std::uint32_t below = 0, at = std::bit_cast<std::uint32_t>(1.0f);
    while (at - below > 1) {
      const std::uint32_t middle = below + (at - below) / 2;
      (display_byte(srgb_from_linear(std::bit_cast<float>(middle))) < byte ? below : at) = middle;
    }
    return std::bit_cast<float>(at);
  }

  std::array<float, 256> least_{};
  std::array<std::uint8_t, (0x3f800000u >> kSkipped) + 1> first_{};  // per leading bits of values up to 1
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
  // The remaining share of the backgrounds' difference; where channels disagree, the smallest share keeps colours in
  // range.
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
  const auto is_partly_covered = [](const glm::vec4& pixel) { return !(pixel.w <= 0.0f || pixel.w >= 1.0f); };
  for (auto pixel = pixels.begin(); pixel != pixels.end();) {
    const auto end = std::find_if(pixel, pixels.end(), is_partly_covered);
    display_bytes({pixel, end}, {}, 4, bytes);  // both are alike for most pixels
    bytes += 4 * (end - pixel);
    for (pixel = end; pixel != pixels.end() && is_partly_covered(*pixel); ++pixel) {
      const glm::vec4 color = layout_color(*pixel);
      for (int channel = 0; channel < 4; ++channel) *bytes++ = display_byte(color[channel]);
    }
  }
}

namespace {

using Bytes = std::vector<std::uint8_t>;

void add_word(Bytes& bytes, std::uint32_t word) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void add_text(Bytes& bytes, std::string_view text) {
  for (const char letter : text) bytes.push_back(static_cast<std::uint8_t>(letter));
}

/// Returns a type and four zero bytes.
Bytes tag(std::string_view type) {
  Bytes bytes;
  add_text(bytes, type);
  add_word(bytes, 0);
  return bytes;
}

/// Appends numbers as s15Fixed16Number (section 4.6).
void add_fixed(Bytes& bytes, std::initializer_list<double> values) {
  for (const double value : values)
    add_word(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536.0))));
}

Bytes numbers(std::string_view type, std::initializer_list<double> values) {
  Bytes bytes = tag(type);
  add_fixed(bytes, values);
  return bytes;
}

/// Returns text in one language (section 10.15).
Bytes text(std::string_view letters) {
  Bytes bytes = tag("mluc");
  add_word(bytes, 1);
  add_word(bytes, 12);  // size of a record in bytes
  add_text(bytes, "enUS");
  add_word(bytes, static_cast<std::uint32_t>(2 * letters.size()));
  add_word(bytes, 28);  // offset of the text
  for (const char letter : letters) {
    bytes.push_back(0);
    bytes.push_back(static_cast<std::uint8_t>(letter));
  }
  return bytes;
}

/// Returns Y = (a X + b)^g from d on, c X below (function type 3, section 10.18).
Bytes curve() {
  Bytes bytes = tag("para");
  bytes.insert(bytes.end(), {0, 3, 0, 0});
  add_fixed(bytes, {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045});
  return bytes;
}

Bytes header(std::size_t size) {
  Bytes bytes;
  add_word(bytes, static_cast<std::uint32_t>(size));
  add_word(bytes, 0);           // no preferred module
  add_word(bytes, 0x04300000);  // version
  add_text(bytes, "mntrRGB XYZ ");
  bytes.insert(bytes.end(), {0x07, 0xda, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0});  // 2010-01-01, the year of the standard
  add_text(bytes, "acsp");
  bytes.resize(68, 0);                      // no platform, flags, device; perceptual
  add_fixed(bytes, {0.9642, 1.0, 0.8249});  // D50
  bytes.resize(128, 0);
  return bytes;
}

Bytes made() {
  const Bytes transfer = curve();
  // Matrices from IEC 61966-2-1 and Lam & Rigg's "Bradford" adaptation from D65 to D50, as in other sRGB profiles.
  const std::pair<std::string_view, Bytes> tags[] = {
      {"desc", text("sRGB IEC61966-2.1")},
      {"cprt", text("No copyright, use freely")},
      {"wtpt", numbers("XYZ ", {0.9642, 1.0, 0.8249})},
      {"chad",
       numbers("sf32", {1.047882, 0.022919, -0.050201, 0.029587, 0.990479, -0.017059, -0.009232, 0.015076, 0.751678})},
      {"rXYZ", numbers("XYZ ", {0.436066, 0.222488, 0.013916})},
      {"gXYZ", numbers("XYZ ", {0.385147, 0.716873, 0.097076})},
      {"bXYZ", numbers("XYZ ", {0.143066, 0.060608, 0.714096})},
      {"rTRC", transfer},
      {"gTRC", transfer},
      {"bTRC", transfer},
  };
  Bytes table, content;
  add_word(table, static_cast<std::uint32_t>(std::size(tags)));
  const std::size_t first = 128 + 4 + 12 * std::size(tags);
  std::size_t shared = 0;  // offset of the curve
  for (const auto& [name, bytes] : tags) {
    const bool is_curve = name.substr(1) == "TRC";
    const std::size_t place = is_curve && shared != 0 ? shared : first + content.size();
    add_text(table, name);
    add_word(table, static_cast<std::uint32_t>(place));
    add_word(table, static_cast<std::uint32_t>(bytes.size()));
    if (place == shared) continue;
    if (is_curve) shared = place;
    content.insert(content.end(), bytes.begin(), bytes.end());
    content.resize((content.size() + 3) / 4 * 4, 0);
  }
  Bytes profile = header(first + content.size());
  profile.insert(profile.end(), table.begin(), table.end());
  profile.insert(profile.end(), content.begin(), content.end());
  return profile;
}

}  // namespace

const std::vector<std::uint8_t>& srgb_profile() {
  static const std::vector<std::uint8_t> profile = made();
  return profile;
}

}  // namespace meniscus
