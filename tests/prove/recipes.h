// SPDX-License-Identifier: BSD-3-Clause
// Random numbers for recipes of families, and the lists of recipes that families.cpp joins.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "tests/support/molecules.h"

namespace meniscus::testing {

inline constexpr double kRadii[] = {1.2, 1.5, 1.52, 1.55, 1.7, 1.8, 2.0};
inline constexpr double kProbes[] = {0.3, 0.5, 0.7, 1.0, 1.4, 1.4, 1.4, 2.0, 3.0, 5.0, 10.0, 50.0};

/// Draws that do not depend on the standard library's distributions.
class Dice {
 public:
  Dice(std::uint32_t family, std::uint32_t n) : bits_(0x9e3779b9u * (family + 1) + n) { bits_.discard(16); }
  double unit() { return bits_() * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  int count(int low, int high) { return low + static_cast<int>(bits_() % static_cast<std::uint32_t>(high - low + 1)); }
  bool chance(double share) { return unit() < share; }
  double radius() { return kRadii[count(0, 6)]; }
  double probe() { return kProbes[count(0, 11)]; }
  double small_probe() { return kProbes[count(0, 8)]; }
  /// Draws from 10^low to 10^high, of either sign.
  double hair(double low, double high) {
    const double size = std::pow(10.0, between(low, high));
    return chance(0.5) ? size : -size;
  }
  glm::dvec3 direction() {
    const double z = between(-1, 1), turn = between(0, 2 * kPi), across = std::sqrt(1 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }
  glm::dvec3 in_cube(double half_edge) {
    const double x = between(-half_edge, half_edge), y = between(-half_edge, half_edge);
    return {x, y, between(-half_edge, half_edge)};
  }
  std::mt19937& bits() { return bits_; }

 private:
  std::mt19937 bits_;
};

/// One input before it is jittered and turned.
struct Made {
  Balls balls;
  double probe_radius;
};

struct Recipe {
  std::string name;
  Made (*make)(Dice&);
};

/// Returns recipes for balls that touch, or miss each other slightly.
std::vector<Recipe> touching_recipes();
/// Returns recipes for helices, common spheres, walls, lattices and orbits of symmetry operators.
std::vector<Recipe> pattern_recipes();

}  // namespace meniscus::testing
