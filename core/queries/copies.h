// SPDX-License-Identifier: BSD-3-Clause
// Surfaces and their copies joined into one surface, row by row, and whether copies keep clear of each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/ball.h"
#include "core/math/rigid_motion.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct RigidMotion;
struct SurfaceObject;

/// Adds a copy of `part`, moved, to `whole`: its tables follow those of `whole`, areas and volumes add up. Surfaces
/// stay closed and their own; where they overlap nothing is cut away. Both need the same probe radius, unless `whole`
/// is still empty. Throws CapacityError when a table gets more rows than an index can count.
void append(Surface& whole, const Surface& part, const RigidMotion& motion = {});

/// One object with every copy of every given one, in order, standing where they are. A single object with a single
/// copy that is not moved passes through as it is. Colours, opacities and atoms follow, the hidden stay hidden;
/// either all objects are coloured by patch kind, alike, or none is. No objects: an empty one. Throws CapacityError.
SurfaceObject merged(std::vector<SurfaceObject> objects);

/// Whether copies look different, each by where it is: a map colours points of an object in several places.
bool copies_differ(std::span<const SurfaceObject> objects);

/// SurfaceObject::atom of an atom of merged(objects), without merging them.
std::uint32_t merged_atom(std::span<const SurfaceObject> objects, std::size_t atom);

/// The balls of every copy of every object, in the order of merged().surface.atoms.
std::vector<Ball> placed_balls(std::span<const SurfaceObject> objects);

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

/// Balls that are at several places.
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
