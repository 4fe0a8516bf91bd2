// SPDX-License-Identifier: BSD-3-Clause
// The distinct colours of a surface and which pieces of which patches bear them.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus::povray {

/// The part of one patch that has one colour.
struct ColoredPiece {
  PatchKind kind = PatchKind::convex;
  std::uint32_t color = 0;  ///< into Palette::colors
  std::uint32_t patch = 0;  ///< into the patch table of its kind
};

/// All pieces in the order they are written: by kind, then colour, then patch.
struct Palette {
  std::vector<glm::vec3> colors;          ///< sRGB, each once, in order of first use
  std::vector<std::uint32_t> atom_color;  ///< per atom, into colors; empty when coloured by patch kind
  std::vector<ColoredPiece> pieces;
};

/// Patches without a face, and curved patches of a probe of radius 0, have no piece.
Palette make_palette(const Surface& surface, const Coloring& coloring);

}  // namespace meniscus::povray
