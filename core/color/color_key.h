// SPDX-License-Identifier: BSD-3-Clause
// The meaning of the colours in a picture, for legends and exporters: scales of numbers and lists of classes.
#pragma once

#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/ordered_classes.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The content of a legend: a scale, or classes, or both if rules accompany a scale, or neither for one fixed colour.
struct ColorKey {
  std::string title;  ///< "chain", "element", ...; the scale has its own
  std::optional<ColorScale> scale;
  /// The classes that occur, in order of first appearance or in an order of their own; then rules that paint atoms in
  /// one colour, by name or expression; then, if rules leave some atoms of one colour, "other".
  std::vector<ColorClass> classes;
  std::vector<ColorKey>
      others{};  ///< keys of rules and objects that are coloured by something else; these have no others

  bool empty() const { return !scale && classes.empty() && others.empty(); }
  /// Returns the title of the scale with its unit, or the title of the classes.
  std::string heading() const;
  /// Returns this key and the others.
  std::vector<const ColorKey*> parts() const;
};

/// The atoms whose colours a key explains.
struct DrawnAtoms {
  std::vector<bool> atoms{};         ///< one per Structure::atoms; empty: all
  std::vector<AtomGroup> objects{};  ///< objects for ColorScheme::By::component
  bool in_a_run = false;             ///< true if rules by position may select other atoms in other frames
};

/// Returns the scales and classes of the colours of drawn atoms. Throws like color_atoms.
ColorKey color_key(const Structure& structure, const ColorScheme& scheme, const DrawnAtoms& drawn = {});

/// Adds the key of further atoms in the picture; if its title has another meaning there, `whose` is appended.
void add_key(ColorKey& key, ColorKey more, const std::string& whose);

/// True if both scales give each number the same colour, and numbers are of the same kind.
bool is_same_scale(const std::optional<ColorScale>& one, const std::optional<ColorScale>& other);

/// Returns the first conflict of pictures side by side, or one after another, as a sentence, with the number of further
/// ones; empty if there is none. Conflicts are: a thing with two colours, a colour with two meanings, a kind of number
/// with two scales. picture: the word for one of them, "panel"; they count from 1.
std::string color_conflicts(std::span<const ColorKey> keys, std::string_view picture);

/// Adds the single colour of some atoms, unless that name is already there, if the key explains anything else.
void add_other(ColorKey& key, const std::string& name, const glm::vec3& color);

}  // namespace meniscus
