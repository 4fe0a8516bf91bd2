// SPDX-License-Identifier: BSD-3-Clause
// The distinct colours of a scene, and the pieces of patches that have each of them.
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

/// The shown part of one patch that has one colour.
struct ColoredPiece {
  PatchKind kind = PatchKind::convex;
  std::uint32_t color = 0;  ///< index into ColorTable::colors()
  std::uint32_t part = 0;   ///< the piece belongs to the atoms with this number in Palette::atom_part
  std::uint32_t patch = 0;  ///< index into the patch table of its kind
  bool by_map = false;      ///< SceneColor::by_map of its colour
};

/// A colour of a scene together with its opacity and its finish. Two colours are the same if all members are.
struct SceneColor {
  glm::vec3 color{0.0f};     ///< sRGB
  float opacity = 1.0f;      ///< in [0, 1]
  bool by_map = false;       ///< true if points have the colours of the scene's volume map wherever it has values
  bool film = false;         ///< true if it is denser at grazing angles; has an effect for opacities below 1 only
  std::uint32_t finish = 0;  ///< 0: the finish of the scene; n: the n-th material of objects, from 1
};

/// The distinct colours of a scene.
class ColorTable {
 public:
  /// Returns the number of a colour, from 0 in order of first use, and adds the colour if it is new.
  std::uint32_t number(SceneColor color);
  /// Returns each colour once, in the order of the numbers.
  const std::vector<SceneColor>& colors() const { return colors_; }
  /// True if the opacity of some colour is less than 1.
  bool is_translucent() const;

 private:
  std::map<std::tuple<float, float, float, float, bool, bool, std::uint32_t>, std::uint32_t> number_;
  std::vector<SceneColor> colors_;
};

/// The properties that all colours of one object of a scene share.
struct ObjectStyle {
  bool film = false;         ///< SceneColor::film
  std::uint32_t finish = 0;  ///< SceneColor::finish
};

/// Returns the colour of the points of an atom. `color` replaces the atom's colour, and a volume map then does not
/// apply.
SceneColor scene_color(const Coloring& coloring, std::uint32_t atom, const ObjectStyle& style,
                       const std::optional<glm::vec3>& color = {});

/// All pieces of one surface in the order in which they are written: by kind, then colour, then patch.
struct Palette {
  /// The part of each atom; kNone if it is hidden. Patches are cut between atoms of different parts.
  std::vector<std::uint32_t> atom_part;
  std::vector<ColoredPiece> pieces;
};

/// Returns the pieces of a surface and adds their colours to `table`. Patches without a face, toroidal and concave
/// patches for a probe of radius 0, and parts of hidden atoms have no piece. Throws Error if the coloring does not have
/// one colour per atom.
Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table,
                     const ObjectStyle& style = {});

}  // namespace meniscus::povray
