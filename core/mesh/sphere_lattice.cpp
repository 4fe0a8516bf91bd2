// SPDX-License-Identifier: BSD-3-Clause
// Spreads points evenly over a sphere by subdividing an icosahedron.
#include "core/mesh/sphere_lattice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

std::array<glm::dvec3, 12> icosahedron() {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  std::array<glm::dvec3, 12> v{{{-1, g, 0},
                                {1, g, 0},
                                {-1, -g, 0},
                                {1, -g, 0},
                                {0, -1, g},
                                {0, 1, g},
                                {0, -1, -g},
                                {0, 1, -g},
                                {g, 0, -1},
                                {g, 0, 1},
                                {-g, 0, -1},
                                {-g, 0, 1}}};
  for (auto& p : v) p = glm::normalize(p);
  return v;
}

constexpr std::array<std::array<int, 3>, 20> kSides{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

}  // namespace

int lattice_frequency(double angle) {
  // The longest of n equal parts of a flat edge, seen from the centre, lies in the middle of a side: its half chord is
  // half the edge / n at the inradius of the icosahedron.
  const double edge = 2.0 / std::sqrt(std::pow((1.0 + std::sqrt(5.0)) / 2.0, 2) + 1.0);
  const double inradius = 0.7946544722917661;
  const double half = std::tan(std::min(angle, 1.2) / 2.0) * inradius;
  return std::max(1, static_cast<int>(std::ceil(edge / (2.0 * half))));
}

SphereLattice sphere_lattice(int frequency) {
  const auto corner = icosahedron();
  SphereLattice lattice;
  // A lattice point is known by its barycentric weights on the named corners, so sides share their rims.
  std::map<std::array<int, 6>, std::uint32_t> known;
  auto point = [&](const std::array<int, 3>& side, int a, int b, int c) {
    std::array<std::array<int, 2>, 3> part{{{side[0], a}, {side[1], b}, {side[2], c}}};
    for (auto& w : part) {
      if (w[1] == 0) w[0] = -1;
    }
    std::sort(part.begin(), part.end());
    const std::array<int, 6> name{part[0][0], part[0][1], part[1][0], part[1][1], part[2][0], part[2][1]};
    const auto [at, fresh] = known.try_emplace(name, static_cast<std::uint32_t>(lattice.directions.size()));
    if (fresh) {
      glm::dvec3 sum(0.0);
      for (const auto& w : part) sum += w[1] ? double(w[1]) * corner[w[0]] : glm::dvec3(0.0);
      lattice.directions.push_back(glm::normalize(sum));
    }
    return at->second;
  };
  const int n = frequency;
  for (const auto& side : kSides) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const int k = n - i - j;
        lattice.triangles.push_back({point(side, k, i, j), point(side, k - 1, i + 1, j), point(side, k - 1, i, j + 1)});
        if (k >= 2) {
          lattice.triangles.push_back(
              {point(side, k - 1, i + 1, j), point(side, k - 2, i + 1, j + 1), point(side, k - 1, i, j + 1)});
        }
      }
    }
  }
  return lattice;
}

}  // namespace meniscus
