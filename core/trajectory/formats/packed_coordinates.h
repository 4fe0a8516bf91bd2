// SPDX-License-Identifier: BSD-3-Clause
// Coordinates as XTC packs them: whole numbers, as differences to the atom before where these are small.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace meniscus {

/// What XTC says in front of the bits (GROMACS manual, file formats: xtc; after F. van Hoesel, 1994).
struct PackedCoordinates {
  float precision = 0.0F;                    ///< steps in a nanometre
  std::array<std::int32_t, 3> lowest = {};   ///< of all atoms, in steps
  std::array<std::int32_t, 3> highest = {};  ///< of all atoms, in steps
  std::int32_t small_class = 0;              ///< place in the format's table of sizes of small differences
  std::span<const std::byte> bits = {};      ///< followed by kPackedPadding readable bytes, which do not count
};

inline constexpr std::size_t kPackedPadding = 32;

/// Unpacks as many positions as there is room for, in Å. Returns what is wrong with the bits or with what is in
/// front of them; empty if nothing is.
std::string unpack(const PackedCoordinates& packed, std::span<glm::dvec3> positions);

}  // namespace meniscus
