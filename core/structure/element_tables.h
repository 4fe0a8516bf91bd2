// SPDX-License-Identifier: BSD-3-Clause
// Van der Waals radii by element, hydropathy and greatest accessible area by residue, each with its source.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// Where a radius comes from.
enum class RadiusSource : std::uint8_t {
  bondi,    ///< A. Bondi, J. Phys. Chem. 68, 441 (1964), and 70, 3006 (1966)
  mantina,  ///< M. Mantina et al., J. Phys. Chem. A 113, 5806 (2009): main-group elements Bondi does not give
  none      ///< neither gives one: kRadiusWithoutSource is used
};

struct ElementRadius {
  double radius;  ///< Å
  RadiusSource source;
};

/// For elements without a published value in the two papers above, in Å.
inline constexpr double kRadiusWithoutSource = 2.0;

/// The radius of the element with this atomic number, in Å; 0 or above 118: no source.
ElementRadius bondi_radius(std::uint8_t element);

/// "Bondi 1964, 1966", "Mantina et al. 2009" or "no published value".
const char* source_name(RadiusSource source);

/// "C", "Zn", ...; "X" for 0 or above 118.
const char* element_symbol(std::uint8_t element);

/// The atomic number of "C", "zn", "CL", ... in any case, D and T as hydrogen; 0: none has this symbol.
std::uint8_t element_of_symbol(std::string_view symbol);

/// Hydropathy of an amino acid, -4.5 (arginine) to 4.5 (isoleucine): J. Kyte and R. F. Doolittle, J. Mol. Biol. 157,
/// 105 (1982), table 2. Force-field names of charge states and selenomethionine go with their parent; NaN for all
/// others.
double hydropathy(std::string_view residue_name);

/// Å²: the greatest solvent-accessible area of such a residue X in Gly-X-Gly, in any conformation: M. Z. Tien et al.,
/// PLoS ONE 8, e80635 (2013), table 1, column "Theoretical". Names as above; NaN for all others.
double greatest_accessible_area(std::string_view residue_name);

/// Å, of the probe of these areas.
inline constexpr double kAccessibilityProbe = 1.4;

}  // namespace meniscus
