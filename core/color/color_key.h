// SPDX-License-Identifier: BSD-3-Clause
// The meaning of the colours in a picture: scales of numbers and lists of classes, for legends and exporters.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/ordered_classes.h"
#include "core/structure/structure.h"

namespace meniscus {

/// What a legend says: a scale, or classes, or both where rules are beside a scale, or neither for one fixed colour.
struct ColorKey {
  std::string title;  ///< "chain", "element", ...; the scale has its own
  std::optional<ColorScale> scale;
  /// Those that occur, in order of first appearance or in an order of their own; then those of rules that paint atoms
  /// in one colour, by their names or expressions; then, where rules leave some of one colour, "other".
  std::vector<ColorClass> classes;
  std::vector<ColorKey> others{};  ///< of rules and of objects that are coloured by something else; without others

  bool empty() const { return !scale && classes.empty() && others.empty(); }
  /// The title of the scale with its unit, or that of the classes.
  std::string heading() const;
  /// Itself and the others.
  std::vector<const ColorKey*> parts() const;
};

/// The atoms whose colours a key explains.
struct DrawnAtoms {
  std::vector<bool> atoms{};         ///< one per Structure::atoms; empty: all
  std::vector<AtomGroup> objects{};  ///< for ColorScheme::By::component
  bool in_a_run = false;             ///< rules by positions may mean other atoms in other frames
};

/// Scales and classes of those colours that some atom drawn has. Throws as color_atoms does.
ColorKey color_key(const Structure& structure, const ColorScheme& scheme, const DrawnAtoms& drawn = {});

/// Adds what further atoms of the picture mean by their colours; where its title has another meaning already, `whose`
/// comes behind it.
void add_key(ColorKey& key, ColorKey more, const std::string& whose);

/// Whether a number has the same colour by both, and is of the same kind.
bool is_same_scale(const std::optional<ColorScale>& one, const std::optional<ColorScale>& other);

/// Where pictures side by side, or one after another, disagree: a thing that has two colours, a colour that is two
/// things, a kind of number with two scales. The first of them as a sentence, and how many more there are; empty: none.
/// picture: what one is called, "panel"; they count from 1.
std::string color_conflicts(std::span<const ColorKey> keys, std::string_view picture);

/// Adds the one colour of some atoms, unless it is there by that name, if there is anything else to explain.
void add_other(ColorKey& key, const std::string& name, const glm::vec3& color);

}  // namespace meniscus
