// SPDX-License-Identifier: BSD-3-Clause
// Draws sugars as the solid symbols of the SNFG, with sticks for their links.
#pragma once

#include <vector>

#include "core/shapes/shapes.h"

namespace meniscus {

/// Half the height (Å) of a symbol, which is about as large as the ring.
inline constexpr double kSymbolRadius = 2.0;

/// Returns a symbol (core/structure/sugars.h) for each sugar with all ring atoms selected. It is in the middle of the
/// ring, upright along the line from the far side of the ring to its anomeric carbon, and has round edges. Sticks
/// (`radius` in Å) lead to the symbols that it is linked to, and to CA of a linked amino acid. Symbols have the colour
/// of the anomeric carbon, their white halves that of the first atom outside of the ring; By::snfg colours both.
Shapes sugar_symbols(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

}  // namespace meniscus
