// SPDX-License-Identifier: BSD-3-Clause
// Monosaccharides and their symbols of the Symbol Nomenclature for Glycans (SNFG).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace meniscus {

struct Atom;

/// The solid that stands for a flat symbol of the SNFG (D. F. Thieker et al., Glycobiology 26, 786, 2016).
enum class SugarSolid : std::uint8_t {
  sphere,           ///< hexoses
  cube,             ///< N-acetylhexosamines
  divided_cube,     ///< hexosamines: one half is white
  divided_diamond,  ///< hexuronates, likewise
  cone,             ///< deoxyhexoses
  star,             ///< pentoses
  diamond,          ///< nonulosonates
  hexagon,          ///< heptoses, Kdo, MurNAc, bacillosamine
  pentagon          ///< ketohexoses
};

/// Names of residues and symbols as in A. Varki et al., Glycobiology 25, 1323 (2015) and S. Neelamegham et al.,
/// Glycobiology 29, 620 (2019).
struct Sugar {
  std::string_view name;  ///< "GlcNAc"
  SugarSolid solid;
  std::uint32_t color;  ///< 0xrrggbb of the SNFG

  bool is_divided() const { return solid == SugarSolid::divided_cube || solid == SugarSolid::divided_diamond; }
};

/// The sugar that this residue is, by the wwPDB's names, CHARMM's, or GLYCAM's (a digit or letter for the links, a
/// letter for the sugar, one for the anomer) where the atoms are those of a sugar's ring. nullptr: none.
const Sugar* sugar_of(std::span<const Atom> residue);

/// The ring in its order, from the anomeric carbon to the oxygen: places in `residue`. Empty: not whole.
struct SugarRing {
  std::array<std::uint32_t, 6> atoms{};
  std::uint32_t count = 0;  ///< 5 or 6; 0: none
};
SugarRing ring_of(std::span<const Atom> residue);

}  // namespace meniscus
