// SPDX-License-Identifier: BSD-3-Clause
// The compressed coordinates of XTC: integers, stored as differences from the previous atom where these are small.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace meniscus {

/// A compressed frame (GROMACS manual, file formats: xtc; after F. van Hoesel, 1994).
struct PackedCoordinates {
  float precision = 0.0F;                    ///< steps per nanometre
  std::array<std::int32_t, 3> lowest = {};   ///< of all atoms, in steps
  std::array<std::int32_t, 3> highest = {};  ///< of all atoms, in steps
  std::int32_t small_class = 0;              ///< index into the format's table of sizes of small differences
  /// Compressed positions; kPackedPadding readable bytes must follow, which do not belong to them.
  std::span<const std::byte> bits = {};
};

/// Bytes that must be readable after the end of PackedCoordinates::bits.
inline constexpr std::size_t kPackedPadding = 32;

/// Unpacks as many positions (Å) as the span has. Returns what is wrong with the frame, as the predicate of a sentence;
/// empty if it is valid.
std::string unpack(const PackedCoordinates& packed, std::span<glm::dvec3> positions);

}  // namespace meniscus
