// SPDX-License-Identifier: BSD-3-Clause
// The colours of a surface, shared by pictures, POV-Ray scenes and Blender files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct VolumePaint;

/// Colours in sRGB, each channel in [0, 1]. A point on a toroidal or concave patch takes the colour of the touched atom
/// a whose contact direction (c_a - s)/|c_a - s|, seen from the probe centre s, is nearest to (x - s)/p: borders of
/// colour are planes through s.
struct Coloring {
  std::vector<glm::vec3> atom{};  ///< one per Surface::atoms
  std::optional<std::array<glm::vec3, 3>>
      kind{};  ///< if set, colours by PatchKind (convex, toroidal, concave) replace colours by atom
  /// If set, points take their colours from this map, except points of atoms with own_color.
  std::shared_ptr<const VolumePaint> volume{};
  std::vector<bool> own_color{};  ///< empty: none; else one per Surface::atoms

  /// Empty: everything is drawn. Else one per Surface::atoms: points that take the colour of a marked atom are not
  /// drawn, in pictures and in exports, for any scheme of colours.
  std::vector<bool> hidden{};

  /// Empty: everything is opaque. Else one per Surface::atoms, in [0, 1]: the share of the background that the points
  /// of this atom cover. 0 is the same as hidden.
  std::vector<float> opacity{};

  /// Empty, or the part of each of Surface::atoms, such as its chain: silhouettes have lines between parts.
  std::vector<std::uint32_t> part{};

  /// Empty, or true for each of Surface::atoms with an outlined patch: pictures have lines on the surface where points
  /// of marked atoms meet points of others.
  std::vector<bool> in_patch{};

  /// Returns the marks by which lines separate atoms: kMarksOfPart times the part, plus the marks of finish.glsl for
  /// inside and outside patches; empty if there are neither parts nor patches.
  std::vector<std::uint32_t> line_marks() const {
    std::vector<std::uint32_t> marks(part.empty() && in_patch.empty() ? 0 : atom.size(), 0);
    for (std::size_t a = 0; a < part.size(); ++a) marks[a] = kMarksOfPart * part[a];
    for (std::size_t a = 0; a < in_patch.size(); ++a) marks[a] += in_patch[a] ? 3 : 2;
    return marks;
  }
  static constexpr std::uint32_t kMarksOfPart = 4;

  /// True if the map colours the points of this atom.
  bool by_volume(std::uint32_t a) const { return volume && (own_color.empty() || !own_color[a]); }
  bool shows(std::uint32_t a) const { return (hidden.empty() || !hidden[a]) && opacity_of(a) > 0.0f; }
  float opacity_of(std::uint32_t a) const { return opacity.empty() ? 1.0f : opacity[a]; }
  /// True if points of some atom are hidden or transparent.
  bool hides_some() const {
    return std::ranges::find(hidden, true) != hidden.end() || std::ranges::find(opacity, 0.0f) != opacity.end();
  }
  /// Returns the share of the light, in [0, 1], that each atom blocks: the square of its opacity, so that what is
  /// inside a transparent surface is lit and a dissolving surface loses its shade gradually.
  std::vector<float> blocking() const {
    std::vector<float> result(atom.size());
    for (std::uint32_t a = 0; a < atom.size(); ++a) result[a] = shows(a) ? opacity_of(a) * opacity_of(a) : 0.0f;
    return result;
  }
  bool is_translucent() const {
    return std::ranges::any_of(opacity, [](float share) { return share > 0.0f && share < 1.0f; });
  }
};

}  // namespace meniscus
