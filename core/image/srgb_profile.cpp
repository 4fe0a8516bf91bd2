// SPDX-License-Identifier: BSD-3-Clause
// Writes the ICC profile of sRGB: header, table of tags, tags, in big-endian numbers.
#include "core/image/srgb_profile.h"

#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace meniscus {
namespace {

using Bytes = std::vector<std::uint8_t>;

void add_word(Bytes& bytes, std::uint32_t word) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void add_text(Bytes& bytes, std::string_view text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

/// A type and four bytes that are zero.
Bytes tag(std::string_view type) {
  Bytes bytes;
  add_text(bytes, type);
  add_word(bytes, 0);
  return bytes;
}

/// s15Fixed16Number, section 4.6.
void add_fixed(Bytes& bytes, std::initializer_list<double> values) {
  for (const double value : values)
    add_word(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536.0))));
}

Bytes numbers(std::string_view type, std::initializer_list<double> values) {
  Bytes bytes = tag(type);
  add_fixed(bytes, values);
  return bytes;
}

/// Text in one language (section 10.15).
Bytes text(std::string_view letters) {
  Bytes bytes = tag("mluc");
  add_word(bytes, 1);
  add_word(bytes, 12);  // bytes of a record
  add_text(bytes, "enUS");
  add_word(bytes, static_cast<std::uint32_t>(2 * letters.size()));
  add_word(bytes, 28);  // where the text begins
  for (const char letter : letters) {
    bytes.push_back(0);
    bytes.push_back(static_cast<std::uint8_t>(letter));
  }
  return bytes;
}

/// Y = (a X + b)^g from d on, c X below (function type 3, section 10.18).
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
  // Matrices after IEC 61966-2-1 and Lam & Rigg's "Bradford" adaptation from D65 to D50, as sRGB profiles have them.
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
  std::size_t shared = 0;  // where the curve lies
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
