// SPDX-License-Identifier: BSD-3-Clause
// Sugars as the solid symbols of the SNFG, and what links them.
#pragma once

#include <vector>

#include "core/shapes/shapes.h"

namespace meniscus {

/// Å: half the height of a symbol, which is about as large as the ring.
inline constexpr double kSymbolRadius = 2.0;

/// A symbol (core/structure/sugars.h) in the middle of the ring of each sugar of which all ring atoms are selected,
/// upright along the line from the far side of the ring to its anomeric carbon; edges are round. Sticks (radius in Å)
/// lead to the symbols that it is linked to, and to CA of a linked amino acid. Symbols have the colour of the anomeric
/// carbon, white halves that of the first atom outside of the ring; By::snfg colours both.
Shapes sugar_symbols(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

}  // namespace meniscus
