// SPDX-License-Identifier: BSD-3-Clause
// Rows of a surface's tables where a copy of it stands; indices stay.
#pragma once

#include <glm/geometric.hpp>

#include "core/math/ball.h"
#include "core/math/rigid_motion.h"
#include "core/surface/primitives.h"

namespace meniscus {

inline Ball moved(Ball ball, const RigidMotion& motion) {
  ball.center = motion(ball.center);
  return ball;
}

inline Plane moved(Plane plane, const RigidMotion& motion) {
  plane.normal = motion.rotation * plane.normal;
  plane.offset += glm::dot(plane.normal, motion.translation);
  return plane;
}

inline ToroidalPatch moved(ToroidalPatch patch, const RigidMotion& motion) {
  patch.center = motion(patch.center);
  patch.axis = motion.rotation * patch.axis;
  patch.start = motion.rotation * patch.start;
  return patch;
}

inline ConcavePatch moved(ConcavePatch patch, const RigidMotion& motion) {
  patch.center = motion(patch.center);
  return patch;
}

}  // namespace meniscus
