// SPDX-License-Identifier: BSD-3-Clause
// Shapes that are drawn in addition to a surface: spheres, cylinders and triangles, each with an atom that gives it its
// colour.
#pragma once

#include "core/structure/structure.h"

namespace meniscus {

struct Ball;

struct SphereShape {
  glm::dvec3 center;   ///< Å
  double radius;       ///< Å
  std::uint32_t atom;  ///< index into Structure::atoms
};

/// The lateral surface of a cylinder, with ends that are covered by spheres of at least its radius. The half at `from`
/// has the colour of `from_atom`, the other half that of `to_atom`.
struct CylinderShape {
  glm::dvec3 from, to;               ///< Å; not the same point
  double radius;                     ///< Å
  std::uint32_t from_atom, to_atom;  ///< indices into Structure::atoms
};

/// A closed mesh with triangles that are counter-clockwise seen from outside.
struct MeshShape {
  std::vector<glm::dvec3> positions;                    ///< Å
  std::vector<glm::vec3> normals;                       ///< per vertex: unit outward normal, interpolated for shading
  std::vector<std::uint32_t> atoms;                     ///< per vertex: index into Structure::atoms
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
};

struct Shapes {
  std::vector<SphereShape> spheres;
  std::vector<CylinderShape> cylinders;
  MeshShape mesh;

  bool empty() const { return spheres.empty() && cylinders.empty() && mesh.triangles.empty(); }
};

/// The default radius of sticks in Å, as in most programs.
inline constexpr double kStickRadius = 0.25;
inline constexpr double kThinStickRadius = 0.15;
inline constexpr double kDashRadius = 0.1;
/// The radius of balls as a share of the van der Waals radius.
inline constexpr double kBallShare = 0.25;

/// In the following functions `selected` has one entry for each atom of the structure, and `bonds` are pairs of indices
/// into Structure::atoms (bonds.h), which are drawn if both atoms are selected. Radii are in Å.

/// Returns a cylinder for each bond, and a sphere of its radius for each atom. An atom without a drawn bond becomes a
/// ball of kBallShare, but no thinner than a stick.
Shapes sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
              double radius = kStickRadius);

/// Returns cylinders and balls: a ball has a share of the van der Waals radius, but is no thinner than a stick.
Shapes balls_and_sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
                        double ball_share = kBallShare, double stick_radius = kThinStickRadius);

/// Returns a sphere for each atom, with a share of its van der Waals radius.
Shapes spheres(const Structure& structure, const std::vector<bool>& selected, double share = 1.0);

/// Returns dashed lines between the atoms of each pair: short cylinders with round ends, one each 0.5 Å.
Shapes dashes(const Structure& structure, std::span<const Bond> pairs, double radius = kDashRadius);

/// Adds a flat body: the polygon, counter-clockwise around the unit normal, extended by `half_thickness` (Å) to both
/// sides. Each point of the polygon must be visible from its middle. All triangles get this atom.
void add_plate(MeshShape& mesh, std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double half_thickness,
               std::uint32_t atom);

/// Appends the second shapes to the first.
void append(Shapes& shapes, const Shapes& more);

/// Returns balls that together hold all shapes, for framing.
std::vector<Ball> balls_around(const Shapes& shapes);

}  // namespace meniscus
