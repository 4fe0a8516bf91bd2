// SPDX-License-Identifier: BSD-3-Clause
// Helices, common spheres, walls, lattices and symmetry operators: many spheres through one point, in every frame.
#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/prove/recipes.h"

namespace meniscus::testing {
namespace {

/// Rounds a sixth of them to single precision, and a sixth to the digits of a PDB file.
Balls stored(Balls balls, Dice& dice) {
  const int how = dice.count(0, 5);
  for (Ball& b : balls)
    for (int k = 0; k < 3; ++k) {
      if (how == 0) b.center[k] = static_cast<float>(b.center[k]);
      if (how == 1) b.center[k] = std::round(b.center[k] * 1000) / 1000;
    }
  return balls;
}

// Boerdijk's and Coxeter's helix: tetrahedra face to face with equal edges; one helix, or some side by side.
Made tetrahelix(Dice& dice) {
  const double p = dice.probe(), r = dice.radius(), fit = r + p;
  const double edges[] = {fit, fit * std::sqrt(8.0 / 3), fit * std::sqrt(3.0), 2 * fit, 2 * r, 1.5};
  const double edge = dice.chance(0.7) ? edges[dice.count(0, 5)] : dice.between(0.8, 2.0) * r;
  const double radius = 0.3 * std::sqrt(3.0) * edge, rise = edge / std::sqrt(10.0), turn = std::acos(-2.0 / 3);
  const int count = dice.count(4, 24), strands = dice.chance(0.8) ? 1 : 2;
  const double aside = dice.chance(0.5) ? edge : dice.between(0.5, 3) * edge;
  Balls balls;
  for (int strand = 0; strand < strands; ++strand)
    for (int n = 0; n < count; ++n)
      balls.push_back({{radius * std::cos(turn * n) + strand * aside, radius * std::sin(turn * n), rise * n}, r});
  return {stored(balls, dice), p};
}

// An n-fold screw axis repeats some atoms, often so far from it that a probe on it touches them.
Made screw(Dice& dice) {
  const double p = dice.chance(0.15) ? 100.0 : dice.probe(), r = dice.radius(), fit = r + p;
  const int fold = dice.count(2, 12), step = dice.count(1, fold), count = dice.count(2, 20);
  const double pitches[] = {fit, 2 * fit, fit * std::sqrt(2.0), fit * std::sqrt(3.0), 2 * r, 0.0};
  const double pitch = dice.chance(0.6) ? pitches[dice.count(0, 5)] : dice.between(1, 8);
  Balls part, balls;
  for (int n = 0, atoms = dice.count(1, 3); n < atoms; ++n) {
    const double radius = dice.chance(0.6) ? fit : dice.between(0.3, 1.5) * fit;
    const double turn = dice.chance(0.5) ? 0.0 : dice.between(0, 2 * kPi);
    part.push_back(
        {{radius * std::cos(turn), radius * std::sin(turn), n * pitch / 3}, dice.chance(0.7) ? r : dice.radius()});
  }
  for (int n = 0; n < count; ++n) {
    const double turn = 2 * kPi * n * step / fold, c = std::cos(turn), s = std::sin(turn);
    for (const Ball& b : part)
      balls.push_back(
          {{c * b.center.x - s * b.center.y, s * b.center.x + c * b.center.y, b.center.z + n * pitch / fold},
           b.radius});
  }
  return {stored(balls, dice), p};
}

// A probe just fits between two walls, or does not; they are parallel, or a wedge.
Made crevice(Dice& dice) {
  const double p = dice.probe(), r = dice.radius(), fit = r + p;
  const double steps[] = {fit, fit * std::sqrt(2.0), 2 * r, fit * std::sqrt(3.0)};
  const double step = dice.chance(0.5) ? steps[dice.count(0, 3)] : dice.between(1, 2) * r;
  const double hair = dice.chance(0.4) ? 0.0 : dice.hair(-10, -1);
  const double wedge = dice.chance(0.5) ? 0.0 : std::pow(10.0, dice.between(-8, -0.5));
  const double shift = dice.chance(0.5) ? 0.0 : 0.5 * step;
  const int across = dice.count(2, 4), along = dice.count(2, 4);
  Balls balls;
  for (const int wall : {-1, 1})
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < along; ++y) {
        const double away = x * step + (wall > 0 ? shift : 0.0), tilt = 0.5 * wall * wedge;
        balls.push_back({{away * std::cos(tilt), y * step + (wall > 0 ? shift : 0.0),
                          wall * (fit + 0.5 * hair) + away * std::sin(tilt)},
                         r});
      }
  return {balls, p};
}

// Rings of atoms, or a solid's corners, lie on one sphere around a probe that touches them.
Made cospherical(Dice& dice) {
  const double p = dice.chance(0.15) ? 100.0 : dice.probe(), r = dice.radius(), fit = r + p;
  const double radius = dice.chance(0.7) ? fit : fit * dice.between(0.5, 1.6);
  Balls balls;
  if (dice.chance(0.15)) {
    balls = c60(1.0, r);
    const double size = glm::length(balls.front().center);
    for (Ball& b : balls) b.center *= radius / size;
    return {stored(balls, dice), p};
  }
  const int around = dice.count(2, 8);
  for (int ring = 0, rings = dice.count(1, 4); ring < rings; ++ring) {
    const double height = dice.chance(0.3) ? 0.0 : dice.between(-1, 1), across = std::sqrt(1 - height * height);
    const double from = dice.chance(0.5) ? 0.0 : dice.between(0, kPi);
    for (int n = 0; n < around; ++n) {
      const double turn = from + 2 * kPi * n / around;
      balls.push_back({radius * glm::dvec3(across * std::cos(turn), across * std::sin(turn), height), r});
    }
  }
  if (dice.chance(0.2)) balls.push_back({{0, 0, radius}, r});
  return {stored(balls, dice), p};
}

// A ball or a slab is filled by a part of a lattice: face-centred, hexagonal, body-centred, diamond.
Made lattice_part(Dice& dice) {
  const double p = dice.probe(), r = dice.radius(), fit = r + p;
  const int kind = dice.count(0, 3);
  // Ties of neighbours' distances: atoms touch; a probe fits between three, or into a tetrahedral or octahedral hole.
  const double ties[] = {2 * r, 2 * fit, fit * std::sqrt(3.0), fit * std::sqrt(8.0 / 3), fit * std::sqrt(2.0), fit};
  const double near = dice.chance(0.7) ? ties[dice.count(0, 5)] : dice.between(1.0, 4.0);
  const double h = std::sqrt(2.0 / 3), t = std::sqrt(3.0);
  const glm::dvec3 cells[] = {glm::dvec3(std::sqrt(2.0)), {1, t, 2 * h}, glm::dvec3(2 / t), glm::dvec3(4 / t)};
  const glm::dvec3 cell = cells[kind];
  std::vector<glm::dvec3> basis = {{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
  if (kind == 1) basis = {{0, 0, 0}, {.5, .5, 0}, {.5, 1.0 / 6, .5}, {0, 2.0 / 3, .5}};
  if (kind == 2) basis = {{0, 0, 0}, {.5, .5, .5}};
  if (kind == 3)
    for (std::size_t n = 0; n < 4; ++n) basis.push_back(basis[n] + 0.25);
  const glm::dvec3 middle = dice.chance(0.4) ? glm::dvec3(0) : dice.in_cube(0.5);
  const double reach = dice.between(0.9, 2.0), thick = dice.chance(0.3) ? dice.between(0.2, 1) : reach;
  const double keep = dice.chance(0.4) ? 1.0 : dice.between(0.3, 0.95);
  Balls balls;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z)
        for (const glm::dvec3& b : basis) {
          const glm::dvec3 at = (glm::dvec3(x, y, z) + b) * cell - middle;
          if (glm::length(at) > reach || std::abs(at.z) > thick || !dice.chance(keep)) continue;
          balls.push_back({near * at, dice.chance(0.97) ? r : dice.radius()});
        }
  if (balls.empty()) balls.push_back({{0, 0, 0}, r});
  return {stored(balls, dice), p};
}

// Operators of files act on a few atoms: digits of a rotation, translations in parts of a cell, one operator applied
// again and again, with all errors of rounding.
Made orbit(Dice& dice) {
  const double p = dice.small_probe(), half = std::sqrt(3.0) / 2, edge = dice.between(3, 9);
  const int digits = dice.count(0, 2);  // all digits, 6 (PDB) or 10
  const auto written = [&](double value) {
    const double unit = digits == 0 ? 0.0 : digits == 1 ? 1e6 : 1e10;
    return unit > 0 ? std::round(value * unit) / unit : value;
  };
  const int fold = dice.count(2, 6);
  const double c = written(std::cos(2 * kPi / fold)), s = written(std::sin(2 * kPi / fold));
  const double flip = dice.chance(0.3) ? -1.0 : 1.0;  // rotoinversion
  const glm::dmat3 turn(flip * glm::dvec3(c, s, 0), flip * glm::dvec3(-s, c, 0), {0, 0, flip});
  const glm::dvec3 shift(0, 0, dice.chance(0.5) ? 0.0 : written(edge / fold));
  const bool hexagonal = dice.chance(0.5);
  Balls balls;
  for (int n = 0, atoms = dice.count(1, 5); n < atoms; ++n) {
    glm::dvec3 x = dice.in_cube(4);
    if (dice.chance(0.3)) x = {0, 0, x.z};                                    // on the axis
    if (dice.chance(0.2)) x = {dice.hair(-12, -5), dice.hair(-12, -5), x.z};  // next to the axis
    const double r = dice.radius();
    for (int copy = 0; copy < 2 * fold && copy < 8; ++copy) {
      balls.push_back({x, r});
      x = turn * x + shift;
    }
  }
  if (dice.chance(0.4)) {  // the next cell
    const glm::dvec3 next = hexagonal ? glm::dvec3(-0.5 * edge, written(half) * edge, 0) : glm::dvec3(edge, 0, 0);
    for (std::size_t n = 0, count = balls.size(); n < count; ++n)
      balls.push_back({balls[n].center + next, balls[n].radius});
  }
  return {stored(balls, dice), p};
}

// Few small atoms are as far apart as a huge probe reaches around them.
Made specks(Dice& dice) {
  const double scale = dice.chance(0.5) ? 0.25 : 1.0, p = (dice.chance(0.5) ? 50.0 : 10.0) * scale;
  const double r = dice.radius() * scale, fit = r + p;
  const double spread = dice.between(0.02, 1.0) * fit;
  Balls balls;
  for (int n = 0, count = dice.count(4, 7); n < count; ++n)
    balls.push_back({dice.chance(0.5) ? dice.in_cube(spread) : spread * dice.direction(),
                     dice.chance(0.7) ? r : dice.between(0.2, 1) * r});
  return {balls, p};
}

}  // namespace

std::vector<Recipe> pattern_recipes() {
  return {{"tetrahelix", tetrahelix},     {"screw", screw}, {"crevice", crevice}, {"cospherical", cospherical},
          {"lattice-part", lattice_part}, {"orbit", orbit}, {"specks", specks}};
}

}  // namespace meniscus::testing
