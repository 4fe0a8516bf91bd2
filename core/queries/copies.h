// SPDX-License-Identifier: BSD-3-Clause
// Joins surfaces and their copies into one surface, finds copies that come too close to each other, and lists the atoms
// of copies: all of them, or those that matter for a camera.
#pragma once

#include "core/color/coloring.h"
#include "core/math/ball.h"
#include "core/math/rigid_motion.h"
#include "core/structure/structure.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct SurfaceObject;

/// Appends a moved copy of `part` to `whole`: its rows follow the rows of `whole`, and areas and volumes add up. Both
/// surfaces remain closed and separate; where they overlap nothing is cut away. Both must have the same probe radius,
/// unless `whole` is still empty. Throws CapacityError if a table gets more rows than an index can count.
void append(Surface& whole, const Surface& part, const RigidMotion& motion = {});

/// Returns one object with every copy of all given objects, in order and in place. A single object with a single copy
/// that is not moved is returned as it is. Colours, opacities and atoms are kept, and hidden atoms stay hidden. Either
/// all objects are coloured alike by patch kind, or none is. Without objects the result is empty. Throws CapacityError.
SurfaceObject merged(std::vector<SurfaceObject> objects);

/// True if copies look different depending on their place: a map colours points of an object that has several copies.
bool copies_differ(std::span<const SurfaceObject> objects);

/// Returns SurfaceObject::atom of an atom of merged(objects) without merging them.
std::uint32_t merged_atom(std::span<const SurfaceObject> objects, std::size_t atom);

/// Returns the balls of every copy of every object, in the order of merged().surface.atoms.
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

/// A group of balls and the motions that give its copies.
struct CopiedBalls {
  std::span<const Ball> balls;
  std::span<const RigidMotion> motions;
};

/// Identifies a ball by its group, the motion of its copy, and its place among the balls of the group.
struct CopiedBall {
  std::uint32_t group = 0, copy = 0, ball = 0;
};

/// Two balls of different copies that one probe can touch at the same time.
struct CopyContact {
  std::array<CopiedBall, 2> ball;
  double distance = 0.0;  ///< Å, between the centres
};

/// Returns the closest such pair (by distance minus radii), or nothing. If there is none, the surface of all copies is
/// the union of their surfaces, because a probe in contact with one copy never meets another. Balls closer than r_i +
/// r_j + 2 probe_radius are in contact; 1e-6 Å is added because moved coordinates are rounded, so that a pair in doubt
/// counts as in contact.
std::optional<CopyContact> closest_contact(std::span<const CopiedBalls> groups, double probe_radius);

/// One copy of an atom: the atom, and the place of its motion among the motions of its group.
struct CopiedAtom {
  std::uint32_t atom = 0, copy = 0;
};

/// Returns the number of atoms of all copies together.
std::size_t placed_count(std::span<const Instances> copies);

/// Returns every atom of every copy: group by group, copy by copy, in the order of the surfaces in merged().
std::vector<CopiedAtom> placed_atoms(std::span<const Instances> copies);

/// Returns the balls of all copies in the order of placed_atoms(). balls: one per atom of the structure, at the place
/// that it has in an unmoved copy.
std::vector<Ball> placed_balls(std::span<const Ball> balls, std::span<const Instances> copies);

/// Returns the balls of a structure's atoms, one per atom; if the structure has copies, the balls of the copies as in
/// reaching_balls(). picked: per atom, true if it is included; empty: all are.
std::vector<Ball> standing_balls(const Structure& structure, const std::vector<bool>& picked = {});

/// Returns the colours of these atoms in the given order. An atom may occur several times.
Coloring coloring_of(const Coloring& coloring, std::span<const std::uint32_t> atoms);

/// Returns balls that extend as far as all copies do, for a camera that must see all of them: the balls of every copy
/// or, if there are more than a million, the balls of each copy that reach farthest in one of 124 directions.
std::vector<Ball> reaching_balls(std::span<const Ball> balls, std::span<const Instances> copies);

}  // namespace meniscus
