// SPDX-License-Identifier: BSD-3-Clause
// The colour tables of elements, residue groups and classes, each with its source.
#include "core/color/named_colors.h"

#include <iterator>
#include <map>

namespace meniscus {
namespace {

constexpr std::uint32_t kOkabeIto[] = {0x56b4e9, 0xe69f00, 0x009e73, 0xcc79a7, 0xf0e442, 0x0072b2, 0xd55e00};
static_assert(3 * std::size(kOkabeIto) == kCategoricalCount);

// H white, C grey, N blue, O red, S yellow, P orange; halogens green to violet; metals a tone each where they are
// common in proteins. Tones are ours, muted so that shading stays visible.
const std::map<std::uint8_t, std::uint32_t> kElements{
    {1, 0xf2f2f2},  {6, 0x9a9a9a},  {7, 0x4666d8},  {8, 0xdd4437},  {9, 0x9fd356},  {11, 0x8e5bd1}, {12, 0x5d9c3a},
    {15, 0xf08a24}, {16, 0xe8c93a}, {17, 0x3fae49}, {19, 0x7d3fb0}, {20, 0x6fa35f}, {25, 0x9c7ac7}, {26, 0xc86a2f},
    {27, 0xdb8aa0}, {28, 0x5fb08c}, {29, 0xc58032}, {30, 0x7d80b0}, {34, 0xd99a1e}, {35, 0x9b3b2a}, {53, 0x7a2a8c}};
constexpr std::uint32_t kOtherElement = 0xd070b0;
constexpr std::uint32_t kUnknownElement = 0xc4c4c4;  // XYZR, which names none

// By chemistry, in Okabe and Ito's colours.
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

glm::vec3 cpk_color(std::uint8_t element) {
  const auto found = kElements.find(element);
  if (element == 0) return color_from_hex(kUnknownElement);
  return color_from_hex(found == kElements.end() ? kOtherElement : found->second);
}

glm::vec3 element_color(std::uint8_t element) {
  constexpr float kWhite = 0.456f;  // makes #c8c8c8 of carbon's #9a9a9a
  return (1.0f - kWhite) * cpk_color(element) + glm::vec3(kWhite);
}

const ResidueGroup& residue_group(const std::string& residue_name) {
  for (const ResidueGroup& group : kResidueGroups) {
    if (!residue_name.empty() && group.members.find(" " + residue_name + " ") != std::string_view::npos) return group;
  }
  return kOtherResidue;
}

}  // namespace meniscus
