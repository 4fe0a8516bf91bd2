// SPDX-License-Identifier: BSD-3-Clause
// Tables of van der Waals radii by element, and of hydropathy and greatest accessible area by residue, with sources.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// The source of a radius.
enum class RadiusSource : std::uint8_t {
  bondi,  ///< A. Bondi, J. Phys. Chem. 68, 441 (1964), and 70, 3006 (1966)
  /// M. Mantina et al., J. Phys. Chem. A 113, 5806 (2009), for main-group elements that Bondi does not give.
  mantina,
  none  ///< no source has a value: kRadiusWithoutSource is used
};

struct ElementRadius {
  double radius;  ///< Å
  RadiusSource source;
};

/// The radius of elements without a value in these two papers, in Å.
inline constexpr double kRadiusWithoutSource = 2.0;

/// Returns the radius of the element with this atomic number. An element of 0 or above 118 has no source.
ElementRadius bondi_radius(std::uint8_t element);

/// Returns "Bondi 1964, 1966", "Mantina et al. 2009" or "no published value".
const char* source_name(RadiusSource source);

/// Returns the symbol of an element, such as "C" or "Zn"; "X" for 0 or above 118.
const char* element_symbol(std::uint8_t element);

/// Returns the atomic number of a symbol such as "C", "zn" or "CL" in any case. D and T are hydrogen. Returns 0 if no
/// element has this symbol.
std::uint8_t element_of_symbol(std::string_view symbol);

/// Returns the hydropathy of an amino acid, from -4.5 (arginine) to 4.5 (isoleucine): J. Kyte and R. F. Doolittle, J.
/// Mol. Biol. 157, 105 (1982), table 2. Force-field names of charge states have the value of the amino acid, and so has
/// selenomethionine. Returns NaN for all other names.
double hydropathy(std::string_view residue_name);

/// Returns the greatest solvent-accessible area (Å²) of a residue X in Gly-X-Gly in any conformation: M. Z. Tien et
/// al., PLoS ONE 8, e80635 (2013), table 1, column "Theoretical". Names are those of hydropathy(). Returns NaN for all
/// other names.
double greatest_accessible_area(std::string_view residue_name);

/// The radius of the probe for these areas, in Å.
inline constexpr double kAccessibilityProbe = 1.4;

}  // namespace meniscus
