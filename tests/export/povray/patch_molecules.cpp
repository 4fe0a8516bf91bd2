// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of the test molecules.
#include "tests/export/povray/patch_molecules.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace meniscus::testing {
namespace {

// Tilts a molecule so that no edge of any patch stays parallel to an axis.
NamedBalls tilted(NamedBalls m) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.8, 0.5, -0.33)), y = glm::normalize(glm::cross(x, {0.1, 0.3, 1.0}));
  for (Ball& b : m.balls)
    b.center = glm::dvec3(0.3, -0.2, 0.1) + b.center.x * x + b.center.y * y + b.center.z * glm::cross(x, y);
  return m;
}

}  // namespace

NamedBalls one_atom() { return {"one_atom", {{{0.3, 0.2, 0.1}, kCarbon}}}; }

NamedBalls free_torus() { return {"free_torus", {{{-2, 0.1, 0}, kCarbon}, {{1.9, 0.3, 0.5}, 1.5}}}; }

NamedBalls free_spindle() {
  const double half = std::sqrt((kCarbon + kWater) * (kCarbon + kWater) - 1.0);
  return {"free_spindle", {{{-half, 0, 0}, kCarbon}, {{half, 0, 0}, kCarbon}}};
}

NamedBalls three_atoms() {
  return tilted({"three_atoms", {{{0, 0, 0}, kCarbon}, {{3.5, 0, 0}, kCarbon}, {{1.6, 3.1, 0}, 1.55}}});
}

NamedBalls wide_arc() { return {"wide_arc", {{{-2, 0, 0}, kCarbon}, {{2, 0, 0}, kCarbon}, {{0.1, 4.2, 0.2}, 1.55}}}; }

NamedBalls cut_probes() {
  return tilted({"cut_probes", {{{-2.8, 0, 0}, kCarbon}, {{2.8, 0, 0}, kCarbon}, {{0, 2, 0}, kCarbon}}});
}

NamedBalls square() {
  NamedBalls m{"square", {}};
  for (const double x : {-1.9, 1.9})
    for (const double y : {-1.9, 1.9}) m.balls.push_back({{x, y, 0}, kCarbon});
  return m;
}

std::vector<NamedBalls> patch_molecules() {
  return {one_atom(),    free_torus(), free_spindle(), three_atoms(),
          wide_arc(),    cut_probes(), square(),       {"gas", gas(3, 12, 8.0, 1.2, 1.8)},
          {"c60", c60()}};
}

Coloring turning_colors(std::size_t atom_count, int color_count) {
  const std::array<glm::vec3, 3> palette{{{0.9f, 0.3f, 0.2f}, {0.2f, 0.5f, 0.9f}, {0.9f, 0.8f, 0.3f}}};
  Coloring c;
  for (std::size_t a = 0; a < atom_count; ++a) c.atom.push_back(palette[static_cast<int>(a) % color_count]);
  return c;
}

}  // namespace meniscus::testing
