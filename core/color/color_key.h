// SPDX-License-Identifier: BSD-3-Clause
// The meaning of colours: the scale of numbers or the list of classes of a scheme, for legends and
// exporters.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/ordered_classes.h"

namespace meniscus {

/// Of each point the distance from the mean of all: what By::radial colours by.
std::vector<double> distances_from_middle(std::span<const glm::dvec3> points);

/// The scale of a scheme that has one. Automatic ranges are the smallest and the largest number, of all frames where
/// these are known; for charges symmetric about 0; for hydrophobicity, rainbow and conservation the ends of their
/// scales. Default maps: charge red-white-blue (negative is red), hydrophobicity blue-white-red, ..., others viridis.
/// Throws as color_atoms does.
ColorScale color_scale(const Structure& structure, const ColorScheme& scheme);

/// What a legend says: a scale, or classes, or both where rules are beside a scale, or neither for one fixed colour.
struct ColorKey {
  std::string title;  ///< "chain", "element", ...; the scale has its own
  std::optional<ColorScale> scale;
  /// Those that occur, in order of first appearance or in an order of their own; then those of rules that paint atoms
  /// in one colour, by their names or expressions; then, where rules leave some of one colour, "other".
  std::vector<ColorClass> classes;
};

/// object_names: for ColorScheme::By::component. Throws as color_atoms does.
ColorKey color_key(const Structure& structure, const ColorScheme& scheme, std::span<const std::string> object_names);

}  // namespace meniscus
