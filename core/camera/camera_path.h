// SPDX-License-Identifier: BSD-3-Clause
// A camera that moves: key frames and what lies between them.
#pragma once

#include <vector>

#include "core/camera/camera.h"

namespace meniscus {

/// A camera at a moment.
struct CameraKey {
  double frame = 0.0;
  Camera camera;
};

/// Goes through its keys smoothly: the target and the logarithms of distance, angle and height along cubic Hermite
/// curves with the slopes of Catmull and Rom (1974) for uneven steps, the axes of the view along the spherical
/// quadrangles of Shoemake (1987). Still before the first key and behind the last.
class CameraPath {
 public:
  /// keys: at least one, frames rising, all of one projection.
  explicit CameraPath(std::vector<CameraKey> keys);
  Camera at(double frame) const;

 private:
  std::vector<CameraKey> keys_;
};

/// The camera carried around the line through `pivot` along `axis` (of length 1) by `angle` (radians, right-handed).
Camera turned(const Camera& camera, const glm::dvec3& pivot, const glm::dvec3& axis, double angle);
/// The camera carried along.
Camera shifted(const Camera& camera, const glm::dvec3& shift);

}  // namespace meniscus
