// SPDX-License-Identifier: BSD-3-Clause
// The rows of patches as their differences from what follows from the atoms, which deflate to half the size.
#pragma once

#include "core/render/ray_cast_pack.h"

namespace meniscus::page {

/// Coordinates (Å) and parts of unit vectors are multiples of this step, so that they take less room.
inline constexpr float kRounding = 1.0f / (1 << 17);
/// The coarser step of numbers that affect only colours: borders between atoms, and fading with depth.
inline constexpr float kColorRounding = 1.0f / (1 << 13);

using RowWords = std::array<std::uint32_t, 4>;

/// Returns the rows of a scene, whose numbers are rounded, sorted by their kind and their place in a primitive. Words
/// are bits of numbers less bits of predicted numbers, with the sign in the lowest bit. balls: centre and radius of
/// each atom, zeros if an atom has none. probe: Å. restored_rows() in data.js is the inverse.
std::vector<RowWords> row_differences(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe);

}  // namespace meniscus::page
