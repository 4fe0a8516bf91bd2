// SPDX-License-Identifier: BSD-3-Clause
// A scalar field on a regular grid in space, such as an electrostatic potential, and its files.
#pragma once

#include <glm/mat3x3.hpp>

#include "core/base/text_file.h"
#include "core/math/box.h"

namespace meniscus {

/// The places of a grid's points.
struct VolumeFrame {
  std::array<std::size_t, 3> size{};  ///< points along each axis, at least two
  glm::dvec3 origin{0.0};             ///< Å: the first point
  glm::dmat3 step{1.0};  ///< columns, Å: the step from a point to the next along each axis; axes may be skewed

  std::size_t count() const { return size[0] * size[1] * size[2]; }
  /// Returns the smallest box around all points.
  Box extent() const;
};

/// The most values of a grid, in every file format that is read: 2^30, which take 4 GiB of memory.
inline constexpr std::size_t kMostVolumeValues = std::size_t{1} << 30;

/// The values at the points of a grid.
class VolumeGrid {
 public:
  /// `values` has one value per point, with the last axis running fastest. Their number must be frame.count(), and the
  /// caller must have checked the size (check_volume_size). `path` is for messages. Throws InputError if the axes lie
  /// in one plane, if a step or the origin is implausibly large, or if a value is not finite.
  VolumeGrid(const std::string& path, const VolumeFrame& frame, std::vector<float> values);

  /// Returns the trilinear interpolation of the eight values around a point (Å); NaN outside of the grid.
  double sample(const glm::dvec3& point) const;

  const VolumeFrame& frame() const { return frame_; }
  const std::vector<float>& values() const { return values_; }

  std::string title, unit;  ///< the file's own description; may be empty

 private:
  VolumeFrame frame_;
  glm::dmat3 to_index_;
  std::vector<float> values_;
};

/// Throws InputError if an axis has fewer than two points, and CapacityError for more than kMostVolumeValues points.
/// `path` and `line` are for messages.
void check_volume_size(const std::string& path, std::size_t line, const std::array<std::int64_t, 3>& size);

/// Reads an OpenDX (as APBS writes it), Gaussian cube or CCP4/MRC file, recognised by its content; gzipped files, too.
/// Throws InputError with file, line and value, and CapacityError.
VolumeGrid read_volume(const std::string& path);

}  // namespace meniscus
