// SPDX-License-Identifier: BSD-3-Clause
// The colour tables, each with its source, and how atoms look themselves up in them.
#include "core/molecule/color_schemes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "core/molecule/reader.h"

namespace meniscus {
namespace {

constexpr glm::vec3 rgb(std::uint32_t hex) {
  return {static_cast<float>(hex >> 16 & 0xff) / 255.0f, static_cast<float>(hex >> 8 & 0xff) / 255.0f,
          static_cast<float>(hex & 0xff) / 255.0f};
}

// Every fifth of the 256 colours of viridis by N. J. Smith, S. van der Walt and E. Firing (matplotlib 1.5, released by
// them under CC0 1.0); linear in between it stays within 1/255 of the full table.
constexpr std::uint32_t kViridis[] = {
    0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781, 0x433d84, 0x414287,
    0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e, 0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e,
    0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c, 0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80,
    0x2eb37c, 0x35b779, 0x3dbc74, 0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840,
    0xa2da37, 0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725};
static_assert(std::size(kViridis) == 52);

// M. Okabe and K. Ito, "Color Universal Design" (2008): told apart with any colour vision. Black is left out, it hides
// the shape. Chains beyond seven take the same hues paler, then darker.
constexpr std::uint32_t kCategorical[] = {0x56b4e9, 0xe69f00, 0x009e73, 0xcc79a7, 0xf0e442, 0x0072b2, 0xd55e00};

// After the space-filling models of R. B. Corey, L. Pauling and W. L. Koltun: H white, C grey, N blue, O red,
// S yellow, P orange; halogens green to violet; metals a tone each where they are common in proteins. Tones are ours,
// muted so that shading stays visible.
const std::map<std::uint8_t, std::uint32_t> kElements{
    {1, 0xf2f2f2},  {6, 0x9a9a9a},  {7, 0x4666d8},  {8, 0xdd4437},  {9, 0x9fd356},  {11, 0x8e5bd1}, {12, 0x5d9c3a},
    {15, 0xf08a24}, {16, 0xe8c93a}, {17, 0x3fae49}, {19, 0x7d3fb0}, {20, 0x6fa35f}, {25, 0x9c7ac7}, {26, 0xc86a2f},
    {27, 0xdb8aa0}, {28, 0x5fb08c}, {29, 0xc58032}, {30, 0x7d80b0}, {34, 0xd99a1e}, {35, 0x9b3b2a}, {53, 0x7a2a8c}};
constexpr std::uint32_t kOtherElement = 0xd070b0;
constexpr std::uint32_t kUnknownElement = 0xc4c4c4;  // XYZR, which names none

// Residue types by chemistry, in Okabe and Ito's colours: acidic, basic, polar, aliphatic, aromatic, sulphur, the two
// that shape the backbone; nucleotides by base. Force-field names of the charge states go with their parent.
const std::pair<std::uint32_t, const char*> kResidueGroups[] = {
    {0xd55e00, " ASP GLU ASH GLH "},  {0x0072b2, " ARG LYS HIS HID HIE HIP HSD HSE HSP LYN "},
    {0x56b4e9, " ASN GLN SER THR "},  {0xcccccc, " ALA VAL LEU ILE "},
    {0x009e73, " PHE TYR TRP "},      {0xf0e442, " CYS CYX CYM MET MSE "},
    {0xcc79a7, " GLY PRO "},          {0xd55e00, " A DA ADE RA "},
    {0x0072b2, " C DC CYT RC "},      {0x009e73, " G DG GUA RG "},
    {0xe69f00, " U DT T THY URA RU "}};
constexpr std::uint32_t kOtherResidue = 0xa0734a;

// Patch kinds: bluish green, sky blue and vermilion of Okabe and Ito.
constexpr std::array<glm::vec3, 3> kPatchKinds{rgb(0x009e73), rgb(0x56b4e9), rgb(0xd55e00)};

glm::vec3 residue_color(const std::string& name) {
  for (const auto& [color, names] : kResidueGroups) {
    if (!name.empty() && std::string_view(names).find(" " + name + " ") != std::string_view::npos) return rgb(color);
  }
  return rgb(kOtherResidue);
}

glm::vec3 chain_color(std::size_t index) {
  const glm::vec3 hue = rgb(kCategorical[index % std::size(kCategorical)]);
  switch (index / std::size(kCategorical) % 3) {
    case 1:
      return 0.5f * hue + glm::vec3(0.5f);
    case 2:
      return 0.6f * hue;
    default:
      return hue;
  }
}

std::vector<glm::vec3> by_chain(const Structure& structure) {
  std::map<std::string, std::size_t> order;  // chains in order of appearance, so that colours follow the file
  std::vector<glm::vec3> colors;
  for (const Atom& atom : structure.atoms) {
    colors.push_back(chain_color(order.try_emplace(atom.chain, order.size()).first->second));
  }
  return colors;
}

std::vector<glm::vec3> by_b_factor(const Structure& structure, const std::optional<std::array<double, 2>>& range) {
  std::array<double, 2> ends{HUGE_VAL, -HUGE_VAL};
  for (const Atom& atom : structure.atoms) {
    if (std::isnan(atom.b_factor)) continue;
    ends = {std::min<double>(ends[0], atom.b_factor), std::max<double>(ends[1], atom.b_factor)};
  }
  if (ends[0] > ends[1]) throw InputError(structure.file, 0, "has no B-factors to colour by; choose another --color");
  if (range) ends = *range;
  std::vector<glm::vec3> colors;
  for (const Atom& atom : structure.atoms) {
    // One value for all atoms has no place on a scale: the middle.
    const double t = ends[1] > ends[0] ? (atom.b_factor - ends[0]) / (ends[1] - ends[0]) : 0.5;
    colors.push_back(std::isnan(atom.b_factor) ? kMissingValueColor : viridis(t));
  }
  return colors;
}

std::vector<glm::vec3> by_order(std::size_t count) {
  std::vector<glm::vec3> colors;
  for (std::size_t n = 0; n < count; ++n) {
    colors.push_back(viridis(count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.5));
  }
  return colors;
}

}  // namespace

std::optional<ColorScheme> parse_color_scheme(std::string_view text) {
  using By = ColorScheme::By;
  constexpr std::pair<std::string_view, By> kNames[] = {{"element", By::element}, {"chain", By::chain},
                                                        {"residue", By::residue}, {"bfactor", By::bfactor},
                                                        {"kind", By::kind},       {"atom", By::atom}};
  for (const auto& [name, by] : kNames) {
    if (text == name) return ColorScheme{by, {}, {}};
  }
  std::uint32_t hex = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, hex, 16);
  if (error != std::errc() || end != text.data() + 7) return std::nullopt;
  return ColorScheme{By::fixed, rgb(hex), {}};
}

std::optional<std::array<double, 2>> parse_color_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  std::array<double, 2> range{};
  if (colon == std::string_view::npos || !parse_number(text.substr(0, colon), range[0]) ||
      !parse_number(text.substr(colon + 1), range[1]) || !(range[0] < range[1])) {
    return std::nullopt;
  }
  return range;
}

Coloring color_atoms(const Structure& structure, const ColorScheme& scheme) {
  using By = ColorScheme::By;
  Coloring coloring;
  switch (scheme.by) {
    case By::element:
      for (const Atom& atom : structure.atoms) coloring.atom.push_back(element_color(atom.element));
      break;
    case By::residue:
      for (const Atom& atom : structure.atoms) coloring.atom.push_back(residue_color(atom.residue_name));
      break;
    case By::chain:
      coloring.atom = by_chain(structure);
      break;
    case By::bfactor:
      coloring.atom = by_b_factor(structure, scheme.range);
      break;
    case By::atom:
      coloring.atom = by_order(structure.atoms.size());
      break;
    case By::fixed:
      coloring.atom.assign(structure.atoms.size(), scheme.fixed);
      break;
    case By::kind:
      coloring.atom.assign(structure.atoms.size(), kMissingValueColor);
      coloring.kind = kPatchKinds;
      break;
  }
  return coloring;
}

glm::vec3 viridis(double t) {
  constexpr std::size_t kLast = std::size(kViridis) - 1;
  const double place = std::clamp(t, 0.0, 1.0) * kLast;
  const std::size_t below = std::min(static_cast<std::size_t>(place), kLast - 1);
  const auto fraction = static_cast<float>(place - static_cast<double>(below));
  return (1.0f - fraction) * rgb(kViridis[below]) + fraction * rgb(kViridis[below + 1]);
}

glm::vec3 element_color(std::uint8_t element) {
  const auto found = kElements.find(element);
  if (element == 0) return rgb(kUnknownElement);
  return rgb(found == kElements.end() ? kOtherElement : found->second);
}

}  // namespace meniscus
