// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of ideal and random molecules, and rigid motions.
#include "tests/support/molecules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

#include "core/structure/formats/read_structure.h"

namespace meniscus::testing {
namespace {

constexpr double kBond = 1.42;

Balls balls_at(const std::vector<glm::dvec3>& points, double factor, double radius) {
  Balls balls;
  for (const glm::dvec3& point : points) balls.push_back({point * factor, radius});
  return balls;
}

// Adds the distinct points that sign changes and cyclic permutations make of one.
void add_cyclic(std::vector<glm::dvec3>& points, const glm::dvec3& x) {
  for (int turn = 0; turn < 3; ++turn)
    for (int signs = 0; signs < 8; ++signs) {
      glm::dvec3 y(x[turn], x[(turn + 1) % 3], x[(turn + 2) % 3]);
      bool distinct = true;
      for (int k = 0; k < 3; ++k) {
        if (!(signs >> k & 1)) continue;
        if (y[k] == 0) distinct = false;
        y[k] = -y[k];
      }
      if (distinct) points.push_back(y);
    }
}

// Returns both atoms of a graphene cell at lattice position (a, b), in the plane.
std::vector<glm::dvec2> graphene_cell(int a, int b) {
  const glm::dvec2 a1(1.5 * kBond, 0.5 * std::sqrt(3.0) * kBond), a2(1.5 * kBond, -0.5 * std::sqrt(3.0) * kBond);
  const glm::dvec2 origin = double(a) * a1 + double(b) * a2;
  return {origin, origin + glm::dvec2(kBond, 0)};
}

}  // namespace

Balls two_atoms(double distance, double radius_a, double radius_b) {
  return {{{0, 0, 0}, radius_a}, {{distance, 0, 0}, radius_b}};
}

Balls collinear(int count, double spacing, double radius) {
  Balls balls;
  for (int n = 0; n < count; ++n) balls.push_back({{n * spacing, 0, 0}, radius});
  return balls;
}

Balls ring(int count, double edge, double radius) {
  Balls balls;
  const double circumradius = 0.5 * edge / std::sin(kPi / count);
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * kPi * n / count;
    balls.push_back({{circumradius * std::cos(angle), circumradius * std::sin(angle), 0}, radius});
  }
  return balls;
}

Balls tetrahedron(double edge, double radius) {
  return balls_at({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, edge / std::sqrt(8.0), radius);
}

Balls lattice(int nx, int ny, int nz, double spacing, double radius) {
  Balls balls;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) balls.push_back({spacing * glm::dvec3(x, y, z), radius});
  return balls;
}

Balls octahedron(double edge, double radius) {
  std::vector<glm::dvec3> points;
  add_cyclic(points, {1, 0, 0});
  return balls_at(points, edge / std::sqrt(2.0), radius);
}

Balls icosahedron(double edge, double radius) {
  std::vector<glm::dvec3> points;
  add_cyclic(points, {0, 1, std::numbers::phi});
  return balls_at(points, edge / 2, radius);
}

Balls c60(double edge, double radius) {
  const double phi = std::numbers::phi;
  std::vector<glm::dvec3> points;
  add_cyclic(points, {0, 1, 3 * phi});
  add_cyclic(points, {1, 2 + phi, 2 * phi});
  add_cyclic(points, {phi, 2, phi * phi * phi});
  return balls_at(points, edge / 2, radius);
}

Balls nanotube(int n, int m, int cells, double radius) {
  const double lattice_constant = std::sqrt(3.0) * kBond;
  const double circumference = lattice_constant * std::sqrt(double(n * n + n * m + m * m));
  const int divisor = std::gcd(2 * m + n, 2 * n + m);
  const double cell_length = std::sqrt(3.0) * circumference / divisor;
  const auto corner = [](int a, int b) { return graphene_cell(a, b)[0]; };
  const glm::dvec2 around = corner(n, m) / circumference, along(-around.y, around.x);
  Balls balls;
  const int reach = 2 * (n + m + 1) * (cells + 1);
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b)
      for (const glm::dvec2& atom : graphene_cell(a, b)) {
        const double x = glm::dot(atom, around) / circumference, z = glm::dot(atom, along);
        if (x < -1e-9 || x >= 1 - 1e-9 || z < -1e-9 || z >= cells * cell_length - 1e-9) continue;
        const double tube_radius = circumference / (2 * kPi);
        balls.push_back({{tube_radius * std::cos(2 * kPi * x), tube_radius * std::sin(2 * kPi * x), z}, radius});
      }
  return balls;
}

Balls graphene(int n, double radius) {
  Balls balls;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (const glm::dvec2& atom : graphene_cell(a, b)) balls.push_back({{atom.x, atom.y, 0}, radius});
  return balls;
}

Balls gas(std::uint32_t seed, int count, double box, double smallest_radius, double largest_radius, double step) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, box), radius(smallest_radius, largest_radius);
  Balls balls;
  for (int n = 0; n < count; ++n) {
    glm::dvec3 center(coordinate(random), coordinate(random), coordinate(random));
    double r = radius(random);
    if (step > 0) {
      center = glm::round(center / step) * step;
      r = std::max(smallest_radius, std::round(r / step) * step);
    }
    balls.push_back({center, r});
  }
  return balls;
}

GasCase gas_case(std::uint32_t n) {
  std::mt19937 random(n + 1);
  std::uniform_real_distribution<double> unit(0, 1);
  const int count = 5 + static_cast<int>(195 * unit(random) * unit(random));
  const double density = 0.005 * std::pow(40.0, unit(random));  // balls per Å³
  const double spread = unit(random) * unit(random);
  const double probe_radius = n % 7 == 0 ? 0.0 : 0.2 * std::pow(20.0, unit(random));
  const double step = n % 3 == 0 ? 1.0 : n % 3 == 1 ? 0.5 : 0.0;
  return {gas(n + 1, count, std::cbrt(count / density), 1.0, 1.0 + 4 * spread, step),
          step > 0 ? std::round(2 * probe_radius) / 2 : probe_radius, step > 0};
}

namespace {

std::vector<NamedBalls> make_degenerate_molecules() {
  const double p = kWater, r = kCarbon, extended = r + p;
  std::vector<NamedBalls> all = {
      {"single", {{{0, 0, 0}, r}}},
      {"two 3.0", two_atoms(3.0)},
      {"two 4.5, almost spindle", two_atoms(4.5)},
      {"two, circle radius equal to the probe's", two_atoms(2 * std::sqrt(extended * extended - p * p))},
      {"two, spindle", two_atoms(5.9)},
      {"two, SAS spheres touch", two_atoms(2 * extended)},
      {"two, SAS spheres overlap by 1e-7", two_atoms(2 * extended - 1e-7)},
      {"two, vdW spheres touch", two_atoms(2 * r)},
      {"two, unequal", two_atoms(2.5, 1.0, 2.0)},
      {"two, far apart", two_atoms(30)},
      {"nested", {{{0.4, 0.3, -0.2}, 1.0}, {{0, 0, 0}, 3.0}}},
      {"internally tangent", two_atoms(2.0, 3.0, 1.0)},
      {"concentric", two_atoms(0.0, 1.0, 3.0)},
      {"coincident", two_atoms(0.0)},
      {"three collinear", collinear(3, 3.0)},
      {"seven collinear", collinear(7, 1.5)},
      {"triangle", ring(3, 2.8)},
      {"triangle, probe just fits", ring(3, extended * std::sqrt(3.0))},
      {"square", ring(4, 3.0)},
      {"square, probe just fits", ring(4, extended * std::sqrt(2.0))},
      {"pentagon", ring(5, 2.4)},
      {"hexagon", ring(6, 1.4)},
      {"hexagon, probe just fits", ring(6, extended)},
      {"ring of 12 with a hole", ring(12, 2.5)},
      {"tetrahedron", tetrahedron(2 * std::sqrt(2.0))},
      {"tetrahedron with a cavity", tetrahedron(extended * std::sqrt(8.0 / 3.0) * 1.01)},
      {"octahedron", octahedron(3.0)},
      {"octahedron, centre just touched", octahedron(extended * std::sqrt(2.0))},
      {"icosahedron", icosahedron(3.2)},
      {"cube", lattice(2, 2, 2, 3.0)},
      {"slab 3x3x1", lattice(3, 3, 1, 3.0)},
      {"lattice 3x3x3", lattice(3, 3, 3, 3.0)},
      {"lattice 3x3x3 with cavities", lattice(3, 3, 3, 3.8)},
      {"lattice 3x3x3, probes just fit", lattice(3, 3, 3, 2 * extended / std::sqrt(3.0))},
      {"lattice 4x4x4", lattice(4, 4, 4, 3.0)},
      {"c60", c60()},
      {"nanotube (5,5)", nanotube(5, 5, 3)},
      {"nanotube (6,0)", nanotube(6, 0, 2)},
      {"nanotube (4,2)", nanotube(4, 2, 1)},
      {"graphene", graphene(3)},
      {"square, large probe", ring(4, 3.0), 5.0},
      {"cube, small probe", lattice(2, 2, 2, 3.6), 0.3},
      {"c60, vdW", c60(), 0.0},
      {"lattice 3x3x3, vdW", lattice(3, 3, 3, 3.0), 0.0},
  };
  Balls doubled = c60();
  const Balls once = doubled;
  doubled.insert(doubled.end(), once.begin(), once.end());
  all.push_back({"c60 twice", doubled});
  Balls thrice = lattice(2, 2, 2, 3.0);
  for (int copy = 0; copy < 16; ++copy) thrice.push_back(thrice[copy]);
  all.push_back({"cube three times", thrice});
  return all;
}

}  // namespace

const std::vector<NamedBalls>& degenerate_molecules() {
  static const std::vector<NamedBalls> molecules = make_degenerate_molecules();
  return molecules;
}

Balls ubiquitin() { return balls_of(read_structure("/usr/share/freesasa/test-data/1ubq.pdb")); }
Balls enterotoxin() { return balls_of(read_structure("/usr/share/pymol/data/demo/1tii.pdb")); }

glm::dmat3 random_rotation(std::mt19937& random) {
  // A uniform unit quaternion (Shoemake 1992) as a matrix.
  std::normal_distribution<double> normal;
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  return glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),  //
                    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),  //
                    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
}

Balls rotated(const Balls& balls, const glm::dmat3& rotation) {
  Balls result = balls;
  for (Ball& b : result) b.center = rotation * b.center;
  return result;
}

Balls translated(const Balls& balls, const glm::dvec3& by) {
  Balls result = balls;
  for (Ball& b : result) b.center += by;
  return result;
}

Balls scaled(const Balls& balls, double factor) {
  Balls result = balls;
  for (Ball& b : result) b = {b.center * factor, b.radius * factor};
  return result;
}

Balls mirrored(const Balls& balls) {
  Balls result = balls;
  for (Ball& b : result) b.center.x = -b.center.x;
  return result;
}

Balls permuted(const Balls& balls, const std::vector<std::uint32_t>& order) {
  Balls result;
  for (const std::uint32_t n : order) result.push_back(balls[n]);
  return result;
}

std::vector<std::uint32_t> random_order(std::size_t count, std::mt19937& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

}  // namespace meniscus::testing
