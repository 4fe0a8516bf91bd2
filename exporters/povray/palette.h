// SPDX-License-Identifier: BSD-3-Clause
// The distinct colours of a scene and which pieces of which patches bear them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus::povray {

/// The part of one patch that has one colour and is shown.
struct ColoredPiece {
  PatchKind kind = PatchKind::convex;
  std::uint32_t color = 0;  ///< into the colours
  std::uint32_t part = 0;   ///< its atoms are those with this number in Palette::atom_part
  std::uint32_t patch = 0;  ///< into the patch table of its kind
  bool by_map = false;      ///< SceneColor::by_map of its colour
};

/// What is distinguished in a scene: a colour, and how what has it covers and shines.
struct SceneColor {
  glm::vec3 color{0.0f};     ///< sRGB
  float opacity = 1.0f;      ///< in [0, 1]
  bool by_map = false;       ///< points have the colours of the scene's volume map, where it reaches
  bool film = false;         ///< denser where the view grazes it; matters where opacity is less than 1
  std::uint32_t finish = 0;  ///< 0: that of the scene; n: that of its object n
};

/// The distinct colours of a scene.
class ColorTable {
 public:
  /// The number of a colour, in order of first use.
  std::uint32_t number(SceneColor color);
  const std::vector<SceneColor>& colors() const { return colors_; }  ///< each once
  bool is_translucent() const;                                       ///< some colour is

 private:
  std::map<std::tuple<float, float, float, float, bool, bool, std::uint32_t>, std::uint32_t> number_;
  std::vector<SceneColor> colors_;
};

/// What the colours of one object of a scene have in common.
struct ObjectStyle {
  bool film = false;         ///< SceneColor::film
  std::uint32_t finish = 0;  ///< SceneColor::finish
};

/// The colour of an atom's points, or `color` in its place, which no map changes.
SceneColor scene_color(const Coloring& coloring, std::uint32_t atom, const ObjectStyle& style,
                       const std::optional<glm::vec3>& color = {});

/// All pieces of one surface in the order they are written: by kind, then colour, then patch.
struct Palette {
  std::vector<std::uint32_t> atom_part;  ///< per atom; kNone: hidden. Patches are cut between atoms of different parts
  std::vector<ColoredPiece> pieces;
};

/// Patches without a face, curved patches of a probe of radius 0, and parts of hidden atoms have no piece. Adds colours
/// to `table`.
Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table,
                     const ObjectStyle& style = {});

}  // namespace meniscus::povray
