// SPDX-License-Identifier: BSD-3-Clause
// The distinct colours of a scene and which pieces of which patches bear them.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/color/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus::povray {

/// The part of one patch that has one colour and is shown.
struct ColoredPiece {
  PatchKind kind = PatchKind::convex;
  std::uint32_t color = 0;  ///< into the colours
  std::uint32_t part = 0;   ///< its atoms are those with this number in Palette::atom_part
  std::uint32_t patch = 0;  ///< into the patch table of its kind
};

/// The distinct colours of a scene, with their opacities.
class ColorTable {
 public:
  /// The number of a colour, in order of first use.
  std::uint32_t number(const glm::vec3& color, float opacity = 1.0f);
  const std::vector<glm::vec4>& colors() const { return colors_; }  ///< sRGB and opacity in (0, 1], each once

 private:
  std::map<std::tuple<float, float, float, float>, std::uint32_t> number_;
  std::vector<glm::vec4> colors_;
};

/// All pieces of one surface in the order they are written: by kind, then colour, then patch.
struct Palette {
  std::vector<std::uint32_t> atom_part;  ///< per atom; kNone: hidden. Patches are cut between atoms of different parts
  std::vector<ColoredPiece> pieces;
};

/// Patches without a face, curved patches of a probe of radius 0, and parts of hidden atoms have no piece. Adds colours
/// to `table`.
Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table);

}  // namespace meniscus::povray
