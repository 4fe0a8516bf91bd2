// SPDX-License-Identifier: BSD-3-Clause
// Computes the scale of a scheme that colours by numbers.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"

namespace meniscus {

/// Returns the distance of each point from the mean of all points, by which By::radial colours.
std::vector<double> distances_from_middle(std::span<const glm::dvec3> points);

/// Returns the scale of a scheme that has one. Automatic ranges are the smallest and the largest number, of all frames
/// where these are known; for charges symmetric about 0; for hydrophobicity, rainbow and conservation the ends of their
/// scales. Default maps: charge red-white-blue (negative is red), hydrophobicity blue-white-red, ..., others viridis.
/// Throws like color_atoms.
ColorScale color_scale(const Structure& structure, const ColorScheme& scheme);

}  // namespace meniscus
