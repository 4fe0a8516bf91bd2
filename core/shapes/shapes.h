// SPDX-License-Identifier: BSD-3-Clause
// What is drawn beside a surface: spheres, cylinders and triangles, each of an atom that gives it its colour.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus {

struct Ball;

struct SphereShape {
  glm::dvec3 center;   ///< Å
  double radius;       ///< Å
  std::uint32_t atom;  ///< into Structure::atoms
};

/// The lateral surface of a cylinder; spheres of at least its radius cover its ends. The half at `from` has the colour
/// of `from_atom`, the other that of `to_atom`.
struct CylinderShape {
  glm::dvec3 from, to;               ///< Å, apart
  double radius;                     ///< Å
  std::uint32_t from_atom, to_atom;  ///< into Structure::atoms
};

/// A mesh, closed and seen from outside counterclockwise.
struct MeshShape {
  std::vector<glm::dvec3> positions;  ///< Å
  std::vector<glm::vec3> normals;     ///< of length 1, outward, one a vertex, for shading between them
  std::vector<std::uint32_t> atoms;   ///< into Structure::atoms, one a vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices
};

struct Shapes {
  std::vector<SphereShape> spheres;
  std::vector<CylinderShape> cylinders;
  MeshShape mesh;

  bool empty() const { return spheres.empty() && cylinders.empty() && mesh.triangles.empty(); }
};

/// Å; those of most programs.
inline constexpr double kStickRadius = 0.25;
inline constexpr double kThinStickRadius = 0.15;
/// Of the van der Waals radius.
inline constexpr double kBallShare = 0.25;

/// In the following `selected` has one entry an atom of the structure, and `bonds` are places in Structure::atoms
/// (bonds.h), drawn if both atoms are selected. Radii are in Å.

/// A cylinder for each bond, and a sphere of its radius for each atom; an atom without a bond that is drawn is a ball
/// of kBallShare, but no thinner than a stick.
Shapes sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
              double radius = kStickRadius);

/// The same with balls of a share of the van der Waals radius, no thinner than a stick.
Shapes balls_and_sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
                        double ball_share = kBallShare, double stick_radius = kThinStickRadius);

/// A sphere of the van der Waals radius, times a share, for each atom.
Shapes spheres(const Structure& structure, const std::vector<bool>& selected, double share = 1.0);

/// Adds a flat body: the polygon, counterclockwise around the normal (of length 1), which reaches as far as
/// `half_thickness` (Å) to both sides. Each point of it is to be seen from its middle. Triangles are of this atom.
void add_plate(MeshShape& mesh, std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double half_thickness,
               std::uint32_t atom);

/// Adds the second to the first.
void append(Shapes& shapes, const Shapes& more);

/// Balls that hold all shapes together, for framing.
std::vector<Ball> balls_around(const Shapes& shapes);

}  // namespace meniscus
