// SPDX-License-Identifier: BSD-3-Clause
// Contains the tables of colours by element, residue type, class and CSS name, and looks up colours.
#include "core/color/named_colors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr std::uint32_t kOkabeIto[] = {0x56b4e9, 0xe69f00, 0x009e73, 0xcc79a7, 0xf0e442, 0x0072b2, 0xd55e00};
static_assert(3 * std::size(kOkabeIto) == kCategoricalCount);

// Any two of the first six differ by at least 12.6 in CIEDE2000, and any two of all by at least 10.9, for normal
// vision and for the three kinds of colour blindness (tests/unit/color/chain_colors_test.cpp).
constexpr std::uint32_t kPastels[] = {0x94cbfb, 0xe9b771, 0xc2a7bc, 0xaabfa6, 0xcb8266,
                                      0x918ec4, 0xe6f1b8, 0x5aa08f, 0xf9e5df, 0xd8ecfb};

// H white, C grey, N blue, O red, S yellow, P orange; halogens green to violet; metals that are common in proteins have
// a tone each. The tones are our own, muted so that shading stays visible.
const std::map<std::uint8_t, std::uint32_t> kElements{
    {1, 0xf2f2f2},  {6, 0x9a9a9a},  {7, 0x4666d8},  {8, 0xdd4437},  {9, 0x9fd356},  {11, 0x8e5bd1}, {12, 0x5d9c3a},
    {15, 0xf08a24}, {16, 0xe8c93a}, {17, 0x3fae49}, {19, 0x7d3fb0}, {20, 0x6fa35f}, {25, 0x9c7ac7}, {26, 0xc86a2f},
    {27, 0xdb8aa0}, {28, 0x5fb08c}, {29, 0xc58032}, {30, 0x7d80b0}, {34, 0xd99a1e}, {35, 0x9b3b2a}, {53, 0x7a2a8c}};
constexpr std::uint32_t kOtherElement = 0xd070b0;
constexpr std::uint32_t kUnknownElement = 0xc4c4c4;  // XYZR has no elements

// These groups follow chemistry, in Okabe and Ito's colours.
constexpr ResidueGroup kResidueGroups[] = {{0xd55e00, "acidic", " ASP GLU ASH GLH "},
                                           {0x0072b2, "basic", " ARG LYS HIS HID HIE HIP HSD HSE HSP LYN "},
                                           {0x56b4e9, "polar", " ASN GLN SER THR "},
                                           {0xcccccc, "aliphatic", " ALA VAL LEU ILE "},
                                           {0x009e73, "aromatic", " PHE TYR TRP "},
                                           {0xf0e442, "sulphur", " CYS CYX CYM MET MSE "},
                                           {0xcc79a7, "glycine, proline", " GLY PRO "},
                                           {0xd55e00, "adenine", " A DA ADE RA "},
                                           {0x0072b2, "cytosine", " C DC CYT RC "},
                                           {0x009e73, "guanine", " G DG GUA RG "},
                                           {0xe69f00, "thymine, uracil", " U DT T THY URA RU "}};
constexpr ResidueGroup kOtherResidue{0xa0734a, "other", ""};

}  // namespace

glm::vec3 categorical_color(std::size_t n) {
  const glm::vec3 hue = color_from_hex(kOkabeIto[n % std::size(kOkabeIto)]);
  switch (n / std::size(kOkabeIto) % 3) {
    case 1:
      return 0.5f * hue + glm::vec3(0.5f);
    case 2:
      return 0.6f * hue;
    default:
      return hue;
  }
}

glm::vec3 chain_color(std::size_t n) {
  const glm::vec3 hue = color_from_hex(kPastels[n % std::size(kPastels)]);
  switch (n / std::size(kPastels) % 3) {
    case 1:
      return 0.7f * hue;
    case 2:
      return 0.5f * hue + glm::vec3(0.5f);
    default:
      return hue;
  }
}

glm::vec3 cpk_color(std::uint8_t element) {
  const auto found = kElements.find(element);
  if (element == 0) return color_from_hex(kUnknownElement);
  return color_from_hex(found == kElements.end() ? kOtherElement : found->second);
}

glm::vec3 element_color(std::uint8_t element) {
  constexpr float kWhite = 0.456f;  // turns carbon's #9a9a9a into #c8c8c8
  return (1.0f - kWhite) * cpk_color(element) + glm::vec3(kWhite);
}

const ResidueGroup& residue_group(const std::string& residue_name) {
  for (const ResidueGroup& group : kResidueGroups) {
    if (!residue_name.empty() && group.members.find(" " + residue_name + " ") != std::string_view::npos) return group;
  }
  return kOtherResidue;
}

namespace {

struct CssColor {
  std::string_view name;
  std::uint32_t hex;
};

// These are sorted by name for binary search.
constexpr CssColor kCssColors[] = {{"aliceblue", 0xf0f8ff},
                                   {"antiquewhite", 0xfaebd7},
                                   {"aqua", 0x00ffff},
                                   {"aquamarine", 0x7fffd4},
                                   {"azure", 0xf0ffff},
                                   {"beige", 0xf5f5dc},
                                   {"bisque", 0xffe4c4},
                                   {"black", 0x000000},
                                   {"blanchedalmond", 0xffebcd},
                                   {"blue", 0x0000ff},
                                   {"blueviolet", 0x8a2be2},
                                   {"brown", 0xa52a2a},
                                   {"burlywood", 0xdeb887},
                                   {"cadetblue", 0x5f9ea0},
                                   {"chartreuse", 0x7fff00},
                                   {"chocolate", 0xd2691e},
                                   {"coral", 0xff7f50},
                                   {"cornflowerblue", 0x6495ed},
                                   {"cornsilk", 0xfff8dc},
                                   {"crimson", 0xdc143c},
                                   {"cyan", 0x00ffff},
                                   {"darkblue", 0x00008b},
                                   {"darkcyan", 0x008b8b},
                                   {"darkgoldenrod", 0xb8860b},
                                   {"darkgray", 0xa9a9a9},
                                   {"darkgreen", 0x006400},
                                   {"darkgrey", 0xa9a9a9},
                                   {"darkkhaki", 0xbdb76b},
                                   {"darkmagenta", 0x8b008b},
                                   {"darkolivegreen", 0x556b2f},
                                   {"darkorange", 0xff8c00},
                                   {"darkorchid", 0x9932cc},
                                   {"darkred", 0x8b0000},
                                   {"darksalmon", 0xe9967a},
                                   {"darkseagreen", 0x8fbc8f},
                                   {"darkslateblue", 0x483d8b},
                                   {"darkslategray", 0x2f4f4f},
                                   {"darkslategrey", 0x2f4f4f},
                                   {"darkturquoise", 0x00ced1},
                                   {"darkviolet", 0x9400d3},
                                   {"deeppink", 0xff1493},
                                   {"deepskyblue", 0x00bfff},
                                   {"dimgray", 0x696969},
                                   {"dimgrey", 0x696969},
                                   {"dodgerblue", 0x1e90ff},
                                   {"firebrick", 0xb22222},
                                   {"floralwhite", 0xfffaf0},
                                   {"forestgreen", 0x228b22},
                                   {"fuchsia", 0xff00ff},
                                   {"gainsboro", 0xdcdcdc},
                                   {"ghostwhite", 0xf8f8ff},
                                   {"gold", 0xffd700},
                                   {"goldenrod", 0xdaa520},
                                   {"gray", 0x808080},
                                   {"green", 0x008000},
                                   {"greenyellow", 0xadff2f},
                                   {"grey", 0x808080},
                                   {"honeydew", 0xf0fff0},
                                   {"hotpink", 0xff69b4},
                                   {"indianred", 0xcd5c5c},
                                   {"indigo", 0x4b0082},
                                   {"ivory", 0xfffff0},
                                   {"khaki", 0xf0e68c},
                                   {"lavender", 0xe6e6fa},
                                   {"lavenderblush", 0xfff0f5},
                                   {"lawngreen", 0x7cfc00},
                                   {"lemonchiffon", 0xfffacd},
                                   {"lightblue", 0xadd8e6},
                                   {"lightcoral", 0xf08080},
                                   {"lightcyan", 0xe0ffff},
                                   {"lightgoldenrodyellow", 0xfafad2},
                                   {"lightgray", 0xd3d3d3},
                                   {"lightgreen", 0x90ee90},
                                   {"lightgrey", 0xd3d3d3},
                                   {"lightpink", 0xffb6c1},
                                   {"lightsalmon", 0xffa07a},
                                   {"lightseagreen", 0x20b2aa},
                                   {"lightskyblue", 0x87cefa},
                                   {"lightslategray", 0x778899},
                                   {"lightslategrey", 0x778899},
                                   {"lightsteelblue", 0xb0c4de},
                                   {"lightyellow", 0xffffe0},
                                   {"lime", 0x00ff00},
                                   {"limegreen", 0x32cd32},
                                   {"linen", 0xfaf0e6},
                                   {"magenta", 0xff00ff},
                                   {"maroon", 0x800000},
                                   {"mediumaquamarine", 0x66cdaa},
                                   {"mediumblue", 0x0000cd},
                                   {"mediumorchid", 0xba55d3},
                                   {"mediumpurple", 0x9370db},
                                   {"mediumseagreen", 0x3cb371},
                                   {"mediumslateblue", 0x7b68ee},
                                   {"mediumspringgreen", 0x00fa9a},
                                   {"mediumturquoise", 0x48d1cc},
                                   {"mediumvioletred", 0xc71585},
                                   {"midnightblue", 0x191970},
                                   {"mintcream", 0xf5fffa},
                                   {"mistyrose", 0xffe4e1},
                                   {"moccasin", 0xffe4b5},
                                   {"navajowhite", 0xffdead},
                                   {"navy", 0x000080},
                                   {"oldlace", 0xfdf5e6},
                                   {"olive", 0x808000},
                                   {"olivedrab", 0x6b8e23},
                                   {"orange", 0xffa500},
                                   {"orangered", 0xff4500},
                                   {"orchid", 0xda70d6},
                                   {"palegoldenrod", 0xeee8aa},
                                   {"palegreen", 0x98fb98},
                                   {"paleturquoise", 0xafeeee},
                                   {"palevioletred", 0xdb7093},
                                   {"papayawhip", 0xffefd5},
                                   {"peachpuff", 0xffdab9},
                                   {"peru", 0xcd853f},
                                   {"pink", 0xffc0cb},
                                   {"plum", 0xdda0dd},
                                   {"powderblue", 0xb0e0e6},
                                   {"purple", 0x800080},
                                   {"rebeccapurple", 0x663399},
                                   {"red", 0xff0000},
                                   {"rosybrown", 0xbc8f8f},
                                   {"royalblue", 0x4169e1},
                                   {"saddlebrown", 0x8b4513},
                                   {"salmon", 0xfa8072},
                                   {"sandybrown", 0xf4a460},
                                   {"seagreen", 0x2e8b57},
                                   {"seashell", 0xfff5ee},
                                   {"sienna", 0xa0522d},
                                   {"silver", 0xc0c0c0},
                                   {"skyblue", 0x87ceeb},
                                   {"slateblue", 0x6a5acd},
                                   {"slategray", 0x708090},
                                   {"slategrey", 0x708090},
                                   {"snow", 0xfffafa},
                                   {"springgreen", 0x00ff7f},
                                   {"steelblue", 0x4682b4},
                                   {"tan", 0xd2b48c},
                                   {"teal", 0x008080},
                                   {"thistle", 0xd8bfd8},
                                   {"tomato", 0xff6347},
                                   {"turquoise", 0x40e0d0},
                                   {"violet", 0xee82ee},
                                   {"wheat", 0xf5deb3},
                                   {"white", 0xffffff},
                                   {"whitesmoke", 0xf5f5f5},
                                   {"yellow", 0xffff00},
                                   {"yellowgreen", 0x9acd32}};
static_assert(std::size(kCssColors) == 148);

std::optional<glm::vec3> parse_hex_color(std::string_view text) {
  if (text.empty() || text[0] != '#' || (text.size() != 4 && text.size() != 7)) return std::nullopt;
  std::uint32_t hex = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), hex, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (text.size() == 4) hex = 0x11 * ((hex & 0xf00) << 8 | (hex & 0xf0) << 4 | (hex & 0xf));
  return color_from_hex(hex);
}

}  // namespace

std::optional<glm::vec3> parse_color(std::string_view text) {
  if (text.starts_with('#')) return parse_hex_color(text);
  const auto found = std::ranges::lower_bound(kCssColors, text, {}, &CssColor::name);
  if (found == std::end(kCssColors) || found->name != text) return std::nullopt;
  return color_from_hex(found->hex);
}

std::string hex_color(const glm::vec3& color) {
  std::string text = "#";
  for (int c = 0; c < 3; ++c) text += fmt::format("{:02x}", std::lround(255.0f * color[c]));
  return text;
}

}  // namespace meniscus
