// SPDX-License-Identifier: BSD-3-Clause
// Whether copies of surfaces keep clear of each other, so that each may be computed alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/surface/primitives.h"

namespace meniscus {

struct RigidMotion;

/// Balls that stand at several places.
struct CopiedBalls {
  std::span<const Ball> balls;
  std::span<const RigidMotion> motions;
};

/// A ball: which of the groups, which of its motions, which of its balls.
struct CopiedBall {
  std::uint32_t group = 0, copy = 0, ball = 0;
};

/// Two balls of different copies that one probe can touch at once.
struct CopyContact {
  std::array<CopiedBall, 2> ball;
  double distance = 0.0;  ///< of the centres, Å
};

/// The closest such pair (by distance minus radii), or nothing: then the surface of all is the union of the surfaces
/// of each, for a probe in contact with one copy never meets another. Balls closer than r_i + r_j + 2 probe_radius are
/// in contact; 1e-6 Å is added, as moved coordinates are rounded, so that doubt counts as contact.
std::optional<CopyContact> closest_contact(std::span<const CopiedBalls> groups, double probe_radius);

}  // namespace meniscus
