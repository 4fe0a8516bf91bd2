// SPDX-License-Identifier: BSD-3-Clause
// Monosaccharides and their symbols in the Symbol Nomenclature for Glycans (SNFG).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace meniscus {

struct Atom;

/// The solid that represents a flat symbol of the SNFG (D. F. Thieker et al., Glycobiology 26, 786, 2016).
enum class SugarSolid : std::uint8_t {
  sphere,           ///< hexoses
  cube,             ///< N-acetylhexosamines
  divided_cube,     ///< hexosamines; one half is white
  divided_diamond,  ///< hexuronates; one half is white
  cone,             ///< deoxyhexoses
  star,             ///< pentoses
  diamond,          ///< nonulosonates
  hexagon,          ///< heptoses, Kdo, MurNAc, bacillosamine
  pentagon          ///< ketohexoses
};

/// A monosaccharide. Names of residues and symbols are those of A. Varki et al., Glycobiology 25, 1323 (2015) and S.
/// Neelamegham et al., Glycobiology 29, 620 (2019).
struct Sugar {
  std::string_view name;  ///< "GlcNAc"
  SugarSolid solid;
  std::uint32_t color;  ///< 0xrrggbb of the SNFG

  bool is_divided() const { return solid == SugarSolid::divided_cube || solid == SugarSolid::divided_diamond; }
};

/// Returns the sugar of a residue by its name in the wwPDB or in CHARMM. A name of GLYCAM (a digit or letter for the
/// links, a letter for the sugar, one for the anomer) counts only if the residue has the ring of a sugar. Returns null
/// if the residue is no sugar.
const Sugar* sugar_of(std::span<const Atom> residue);

/// The ring of a sugar, in order from the anomeric carbon to the oxygen, as places in `residue`.
struct SugarRing {
  std::array<std::uint32_t, 6> atoms{};
  std::uint32_t count = 0;  ///< 5 or 6; 0 if the ring is incomplete
};
SugarRing ring_of(std::span<const Atom> residue);

}  // namespace meniscus
