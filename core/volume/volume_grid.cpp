// SPDX-License-Identifier: BSD-3-Clause
// Checks the size of volume grids, and samples them between their points.
#include "core/volume/volume_grid.h"

#include <cassert>

#include <glm/matrix.hpp>

#include "core/math/double_geometry.h"

namespace meniscus {
namespace {

constexpr double kLargestPlace = 1e6;  // Å
constexpr double kFlattest = 1e-6;     // smallest volume of a cell, as a share of a box with the same edges

/// Throws InputError for steps or an origin that no map has.
void check_frame(const std::string& path, const VolumeFrame& frame) {
  double edges = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(frame.step[axis]);
    edges *= length;
    if (!(length > 0.0 && length * static_cast<double>(frame.size[axis]) < kLargestPlace))
      throw InputError(path, 0, "steps by {:.6g} Å along axis {}; is the unit right?", length, axis + 1);
    if (!(std::abs(frame.origin[axis]) < kLargestPlace))
      throw InputError(path, 0, "begins at {:.6g} Å; is the unit right?", frame.origin[axis]);
  }
  if (!(std::abs(glm::determinant(frame.step)) > kFlattest * edges))
    throw InputError(path, 0, "has axes that lie in one plane; correct its steps");
}

using geometry::real;
using geometry::real3;
using geometry::uint;
using std::min;

/// Interpolates by the code that the shaders of pages use, too.
struct Values {
  const float* values;
  real grid_value(uint n) const { return values[n]; }
#include "gpu_shaders/geometry/trilinear.glsl"
};

}  // namespace

Box VolumeFrame::extent() const {
  Box box;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    glm::dvec3 point = origin;
    for (int axis = 0; axis < 3; ++axis)
      if (corner >> axis & 1) point += static_cast<double>(size[axis] - 1) * step[axis];
    box.include(point);
  }
  return box;
}

VolumeGrid::VolumeGrid(const std::string& path, const VolumeFrame& frame, std::vector<float> values)
    : frame_(frame), to_index_(1.0), values_(std::move(values)) {
  assert(values_.size() == frame_.count());
  check_frame(path, frame_);
  to_index_ = glm::inverse(frame_.step);
  const auto wrong = std::ranges::find_if_not(values_, [](float value) { return std::isfinite(value); });
  if (wrong != values_.end())
    throw InputError(path, 0, "holds {} as value {}, which is not finite; compute the map again", *wrong,
                     with_thousands(static_cast<std::size_t>(wrong - values_.begin()) + 1));
}

double VolumeGrid::sample(const glm::dvec3& point) const {
  const glm::dvec3 place = to_index_ * (point - frame_.origin);
  const auto count = [&](int axis) { return static_cast<std::uint32_t>(frame_.size[axis]); };
  Values values{values_.data()};
  if (!values.on_grid(place, count(0), count(1), count(2))) return std::numeric_limits<double>::quiet_NaN();
  return values.trilinear(place, count(0), count(1), count(2));
}

void check_volume_size(const std::string& path, std::size_t line, const std::array<std::int64_t, 3>& size) {
  std::size_t count = 1;
  for (const std::int64_t points : size) {
    if (points < 2)
      throw InputError(path, line, "says {} x {} x {} points; a grid has at least two along each axis", size[0],
                       size[1], size[2]);
    if (static_cast<std::size_t>(points) > kMostVolumeValues / count)
      throw CapacityError(
          "{}: says {} x {} x {} points, more than this program reads; cut the map or make it "
          "coarser",
          path, size[0], size[1], size[2]);
    count *= static_cast<std::size_t>(points);
  }
}

}  // namespace meniscus
