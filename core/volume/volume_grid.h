// SPDX-License-Identifier: BSD-3-Clause
// A scalar field on a regular grid in space, such as an electrostatic potential.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/math/box.h"

namespace meniscus {

/// Where the points of a grid are.
struct VolumeFrame {
  std::array<std::size_t, 3> size{};  ///< points along each axis, at least two
  glm::dvec3 origin{0.0};             ///< Å: of the first point
  glm::dmat3 step{1.0};               ///< columns, Å: from a point to the next along each axis; they may be skewed

  std::size_t count() const { return size[0] * size[1] * size[2]; }
  /// The least box around all points.
  Box extent() const;
};

/// As many values as all programs' files of them hold; 4 GiB in memory.
inline constexpr std::size_t kMostVolumeValues = std::size_t{1} << 30;

/// Values at the points of a grid.
class VolumeGrid {
 public:
  /// values: the last axis runs fastest. path: for messages. Throws InputError unless the axes span space, there are
  /// two points along each, and all is finite; values must be as many as points.
  VolumeGrid(const std::string& path, const VolumeFrame& frame, std::vector<float> values);

  /// Trilinear between the eight points around; NaN outside. point: Å.
  double sample(const glm::dvec3& point) const;

  const VolumeFrame& frame() const { return frame_; }
  const std::vector<float>& values() const { return values_; }

  std::string title, unit;  ///< what the file says of itself; may be empty

 private:
  VolumeFrame frame_;
  glm::dmat3 to_index_;
  std::vector<float> values_;
};

/// Throws InputError for sizes that no grid has, CapacityError for more than kMostVolumeValues points. line: for
/// messages.
void check_volume_size(const std::string& path, std::size_t line, const std::array<std::int64_t, 3>& size);

}  // namespace meniscus
