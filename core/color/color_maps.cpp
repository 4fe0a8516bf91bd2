// SPDX-License-Identifier: BSD-3-Clause
// Contains the built-in maps, and looks up the colour of a number on a map or on a scale.
#include "core/color/color_maps.h"

#include <cmath>
#include <iterator>

#include "core/color/named_colors.h"

namespace meniscus {
namespace {

// Every fifth of the 256 colours of each map; linear in between they stay within 1/255 of the full tables of viridis
// and magma, and within 4/255 of that of cividis, whose blue has a sharp bend.
constexpr std::size_t kTableSize = 52;
using Table = std::array<std::uint32_t, kTableSize>;

constexpr Table kViridis{0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781,
                         0x433d84, 0x414287, 0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e,
                         0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e, 0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c,
                         0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80, 0x2eb37c, 0x35b779, 0x3dbc74,
                         0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840, 0xa2da37,
                         0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725};

constexpr Table kCividis{0x00224e, 0x002656, 0x002a5f, 0x002d68, 0x003070, 0x083370, 0x163770, 0x203a6f, 0x273e6e,
                         0x2e416d, 0x34456c, 0x3a486c, 0x3f4c6c, 0x444f6c, 0x49536c, 0x4e566c, 0x535a6d, 0x575d6d,
                         0x5c616e, 0x60646f, 0x656870, 0x696b71, 0x6d6f72, 0x727274, 0x767676, 0x7a7a78, 0x7e7d78,
                         0x838179, 0x888578, 0x8d8878, 0x928c78, 0x969077, 0x9b9476, 0xa09875, 0xa59c74, 0xaaa073,
                         0xafa471, 0xb5a86f, 0xbaac6d, 0xbfb06b, 0xc4b468, 0xc9b965, 0xcfbd62, 0xd4c15f, 0xdac65b,
                         0xdfca57, 0xe5cf52, 0xead34c, 0xf0d846, 0xf6dd3f, 0xfce236, 0xfee838};

constexpr Table kMagma{0x000004, 0x02020b, 0x050416, 0x090720, 0x0e0b2b, 0x140e36, 0x1a1042, 0x21114e, 0x29115a,
                       0x311165, 0x390f6e, 0x420f75, 0x4a1079, 0x52137c, 0x5a167e, 0x621980, 0x6a1c81, 0x721f81,
                       0x792282, 0x812581, 0x892881, 0x912b81, 0x992d80, 0xa1307e, 0xaa337d, 0xb2357b, 0xba3878,
                       0xc23b75, 0xca3e72, 0xd2426f, 0xd9466b, 0xe04c67, 0xe75263, 0xec5860, 0xf1605d, 0xf4695c,
                       0xf7725c, 0xf97b5d, 0xfb8560, 0xfc8e64, 0xfd9869, 0xfea16e, 0xfeaa74, 0xfeb47b, 0xfebd82,
                       0xfec68a, 0xfecf92, 0xfed89a, 0xfde2a3, 0xfdebac, 0xfcf4b6, 0xfcfdbf};

// The usual map of signed numbers: linear in sRGB between its colours, which are muted so that shading stays visible.
constexpr std::array<std::uint32_t, 3> kBlueWhiteRed{0x2a4fd7, 0xffffff, 0xd2322a};
constexpr std::array<std::uint32_t, 3> kRedWhiteBlue{0xd2322a, 0xffffff, 0x2a4fd7};

// Each of these maps goes from light to dark. The first of nine colours is left out, because on white it has no visible
// edge, and so are the last two, which hide shade.
constexpr std::array<std::uint32_t, 6> kBlues{0xdeebf7, 0xc6dbef, 0x9ecae1, 0x6baed6, 0x4292c6, 0x2171b5};
constexpr std::array<std::uint32_t, 6> kYlOrRd{0xffeda0, 0xfed976, 0xfeb24c, 0xfd8d3c, 0xfc4e2a, 0xe31a1c};

// Grades 1 (variable) to 9 (conserved).
constexpr std::array<std::uint32_t, 9> kConsurf{0x10c8d1, 0x8cffff, 0xd7ffff, 0xeaffff, 0xffffff,
                                                0xfcedf4, 0xfac9de, 0xf07dab, 0xa02560};

// Okabe and Ito's hues in the order of the spectrum.
constexpr std::array<std::uint32_t, 6> kRainbow{0x0072b2, 0x56b4e9, 0x009e73, 0xf0e442, 0xe69f00, 0xd55e00};

// These tones are as light as the colours of chains. Any two differ by at least 7.1 in CIEDE2000 for any colour vision.
constexpr std::array<std::uint32_t, 6> kPastel{0x84a9ea, 0x8ad0de, 0xc3e7b4, 0xf7e294, 0xe8a474, 0xcb7a78};

// The order of these maps is that of ColorMap.
constexpr ColorMapMetadata kMaps[] = {
    {ColorMap::viridis, "viridis", "N. J. Smith, S. van der Walt and E. Firing, matplotlib 1.5 (2015), CC0 1.0",
     kViridis},
    {ColorMap::cividis, "cividis",
     "J. R. Nunez, C. R. Anderton and R. S. Renslow, PLoS ONE 13, e0199239 (2018), CC BY 4.0; sampled", kCividis},
    {ColorMap::magma, "magma", "N. J. Smith and S. van der Walt, matplotlib 1.5 (2015), CC0 1.0", kMagma},
    {ColorMap::blue_white_red, "blue-white-red", "linear between its three colours", kBlueWhiteRed},
    {ColorMap::red_white_blue, "red-white-blue", "the reverse: red is negative, as is usual for electrostatics",
     kRedWhiteBlue},
    {ColorMap::blues, "blues",
     "C. A. Brewer, ColorBrewer 2.0 (2013), Apache 2.0; light, without its palest and darkest", kBlues},
    {ColorMap::ylorrd, "ylorrd",
     "C. A. Brewer, ColorBrewer 2.0 (2013), Apache 2.0; light, without its palest and darkest", kYlOrRd},
    {ColorMap::consurf, "consurf",
     "grades 1 to 9: H. Ashkenazy et al., Nucleic Acids Res. 44, W344 (2016); @color-range 1:9@", kConsurf},
    {ColorMap::rainbow, "rainbow", "linear between hues of Okabe and Ito, from blue to red; for @color rainbow@",
     kRainbow},
    {ColorMap::pastel, "pastel",
     "linear between our own light tones, from blue to red; for a single chain (@color auto@)", kPastel},
    {ColorMap::categorical, "categorical", "M. Okabe and K. Ito, Color Universal Design (2008)", kViridis},
};

const ColorMapMetadata& metadata_of(ColorMap map) { return kMaps[static_cast<std::size_t>(map)]; }

glm::vec3 between(std::span<const std::uint32_t> table, double t) {
  const std::size_t last = table.size() - 1;
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(last);
  const std::size_t below = std::min(static_cast<std::size_t>(place), last - 1);
  const auto fraction = static_cast<float>(place - static_cast<double>(below));
  return (1.0f - fraction) * color_from_hex(table[below]) + fraction * color_from_hex(table[below + 1]);
}

}  // namespace

std::span<const ColorMapMetadata> color_maps() { return kMaps; }

std::string_view map_name(ColorMap map) { return metadata_of(map).name; }

std::optional<ColorMap> parse_color_map(std::string_view text) {
  const auto found = std::ranges::find(kMaps, text, &ColorMapMetadata::name);
  if (found == std::end(kMaps)) return std::nullopt;
  return found->map;
}

glm::vec3 mapped_color(ColorMap map, double t) {
  if (map != ColorMap::consurf) return between(metadata_of(map).colors, t);
  return color_from_hex(kConsurf[static_cast<std::size_t>(std::clamp(t, 0.0, 1.0) * (kConsurf.size() - 1) + 0.5)]);
}

std::size_t map_steps(ColorMap map) { return map == ColorMap::consurf ? kConsurf.size() : 0; }

glm::vec3 default_missing_color(ColorMap map) {
  // The middle of cividis is grey itself.
  return color_from_hex(map == ColorMap::cividis ? 0xcc79a7 : map == ColorMap::consurf ? 0xffff96 : 0x808080);
}

glm::vec3 ColorRamp::color(double t) const {
  t = std::clamp(t, 0.0, 1.0);
  const auto behind = std::ranges::upper_bound(places, t);
  const std::size_t above =
      std::clamp<std::size_t>(static_cast<std::size_t>(behind - places.begin()), 1, places.size() - 1);
  const auto share = static_cast<float>((t - places[above - 1]) / (places[above] - places[above - 1]));
  return (1.0f - share) * colors[above - 1] + share * colors[above];
}

glm::vec3 ColorScale::color(double number) const {
  if (std::isnan(number)) return missing_color;
  if (of_colors) return color_from_hex(static_cast<std::uint32_t>(number));
  if (map == ColorMap::categorical) {
    return categorical_color(static_cast<std::size_t>(std::ranges::lower_bound(classes, number) - classes.begin()));
  }
  const double width = range[1] - range[0];
  const double t = width > 0.0 ? (number - range[0]) / width : 0.5;
  return own_map ? own_map->color(t) : mapped_color(map, t);
}

}  // namespace meniscus
