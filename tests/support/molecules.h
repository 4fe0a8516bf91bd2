// SPDX-License-Identifier: BSD-3-Clause
// Molecules with known surfaces, degenerate on purpose or random by seed, and the motions that must not change a
// surface.
#pragma once

#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus::testing {

using Balls = std::vector<Ball>;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kCarbon = 1.7;
inline constexpr double kWater = 1.4;

/// Returns two atoms on the x axis, `distance` apart.
Balls two_atoms(double distance, double radius_a = kCarbon, double radius_b = kCarbon);
/// Returns `count` atoms on the x axis.
Balls collinear(int count, double spacing, double radius = kCarbon);
/// A planar regular polygon of given edge around the origin.
Balls ring(int count, double edge, double radius = kCarbon);
/// Four alternate corners of a cube, edge = sqrt(2) * the cube's.
Balls tetrahedron(double edge, double radius = kCarbon);
/// A block of a cubic lattice.
Balls lattice(int nx, int ny, int nz, double spacing, double radius = kCarbon);
Balls octahedron(double edge, double radius = kCarbon);
Balls icosahedron(double edge, double radius = kCarbon);
/// Truncated icosahedron: all 90 edges equal.
Balls c60(double edge = 1.45, double radius = kCarbon);
/// Ideal (n, m) carbon nanotube: graphene of bond length 1.42 Å rolled up, `cells` translational cells long.
Balls nanotube(int n, int m, int cells, double radius = kCarbon);
/// Returns an ideal graphene flake of bond length 1.42 Å: flat hexagons, n x n cells.
Balls graphene(int n, double radius = kCarbon);

/// Returns uniformly random balls in a cube of side `box`; coordinates are multiples of `step` if step > 0 (ties).
Balls gas(std::uint32_t seed, int count, double box, double smallest_radius, double largest_radius, double step = 0);

/// The n-th of an endless list of gases: 5 to 200 balls, sparse to crowded, equal radii to five-fold ones, any probe
/// radius from 0 to 4 Å; two of three on a grid of 1 or 0.5 Å with probe and radii to match, so that ties abound.
struct GasCase {
  Balls balls;
  double probe_radius;
  bool on_grid;
};
GasCase gas_case(std::uint32_t n);

/// A molecule with a name, for tests that go through all of them.
struct NamedBalls {
  std::string name;
  Balls balls;
  double probe_radius = kWater;
};
/// Every degenerate molecule worth trying, small enough for hundreds of surfaces. Made once: names of tests ask often.
const std::vector<NamedBalls>& degenerate_molecules();

/// Returns 1UBQ of Debian's freesasa (602 atoms); enterotoxin() is 1TII of pymol-data (5,469). No water, Bondi radii.
Balls ubiquitin();
Balls enterotoxin();

glm::dmat3 random_rotation(std::mt19937& random);
Balls rotated(const Balls& balls, const glm::dmat3& rotation);
Balls translated(const Balls& balls, const glm::dvec3& by);
Balls scaled(const Balls& balls, double factor);
Balls mirrored(const Balls& balls);
/// order[n] = index in `balls` of the n-th result.
Balls permuted(const Balls& balls, const std::vector<std::uint32_t>& order);
std::vector<std::uint32_t> random_order(std::size_t count, std::mt19937& random);

}  // namespace meniscus::testing
