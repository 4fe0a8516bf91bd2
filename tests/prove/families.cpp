// SPDX-License-Identifier: BSD-3-Clause
// Makes the families: each a small recipe that puts spheres, circles or probes exactly where decisions are ties.
#include "tests/prove/families.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "tests/prove/recipes.h"

namespace meniscus::testing {
namespace {

Made through_one_point(Dice& dice) {
  const double p = dice.probe();
  Balls balls;
  const double equal = dice.chance(0.4) ? dice.radius() : 0.0;
  const bool planar = dice.chance(0.2);
  for (int n = 0, count = dice.count(4, 9); n < count; ++n) {
    const double r = equal > 0 ? equal : dice.radius();
    glm::dvec3 direction = dice.direction();
    if (planar) direction = glm::normalize(glm::dvec3(direction.x, direction.y, 0.0));
    balls.push_back({direction * (r + p), r});
  }
  return {balls, p};
}

// The centres of spheres through two points lie on one circle's plane, and the spheres share a circle's two poles.
Made through_two_points(Dice& dice) {
  const double p = dice.probe(), half = dice.between(0.05, 0.95);
  Balls balls;
  for (int n = 0, count = dice.count(4, 8); n < count; ++n) {
    const double r = dice.radius(), turn = dice.between(0, 2 * kPi);
    const double along = half * (1.2 + p), out = std::sqrt((r + p) * (r + p) - along * along);
    balls.push_back({{out * std::cos(turn), out * std::sin(turn), 0}, r});
  }
  return {balls, p};
}

Made tube(Dice& dice) {
  const double p = dice.small_probe(), r = dice.radius();
  const int around = dice.count(3, 12), layers = dice.count(1, 5);
  const double radius = dice.chance(0.7) ? r + p : dice.between(0.6, 1.4) * (r + p);
  const double step = dice.chance(0.5) ? radius : dice.between(0.5, 2.0) * r;
  const bool staggered = dice.chance(0.5);
  Balls balls;
  for (int layer = 0; layer < layers; ++layer)
    for (int n = 0; n < around; ++n) {
      const double turn = 2 * kPi * (n + (staggered && layer % 2 ? 0.5 : 0.0)) / around;
      balls.push_back({{radius * std::cos(turn), radius * std::sin(turn), step * layer}, r});
    }
  return {balls, p};
}

Balls dodecahedron(double radius, double r) {
  const double phi = std::numbers::phi;
  Balls balls;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) balls.push_back({{x, y, z}, r});
      balls.push_back({{0, x / phi, y * phi}, r});
      balls.push_back({{x / phi, y * phi, 0}, r});
      balls.push_back({{x * phi, 0, y / phi}, r});
    }
  for (Ball& b : balls) b.center *= radius / std::sqrt(3.0);
  return balls;
}

// The circumradius is exactly r + p (a probe just fits the centre), or an edge lets a probe just pass a face.
Made solid(Dice& dice) {
  const double p = dice.small_probe(), r = dice.radius(), fit = r + p;
  const int kind = dice.count(0, 4), tie = dice.count(0, 3);
  const double free_edge = dice.between(0.5, 1.6) * fit;
  Balls balls;
  switch (kind) {
    case 0:
      balls = tetrahedron(tie == 0 ? fit * std::sqrt(8.0 / 3) : tie == 1 ? fit * std::sqrt(3.0) : free_edge, r);
      break;
    case 1:
      balls = octahedron(tie == 0 ? fit * std::sqrt(2.0) : tie == 1 ? fit * std::sqrt(3.0) : free_edge, r);
      break;
    case 2:
      balls = lattice(2, 2, 2, tie == 0 ? fit * 2 / std::sqrt(3.0) : tie == 1 ? fit * std::sqrt(2.0) : free_edge, r);
      break;
    case 3:
      balls = icosahedron(tie == 0 ? fit / std::sin(2 * kPi / 5) : tie == 1 ? fit * std::sqrt(3.0) : free_edge, r);
      break;
    default:
      balls = dodecahedron(tie == 0 ? fit : free_edge, r);
  }
  if (dice.chance(0.2)) balls.push_back({{0, 0, 0}, dice.radius()});
  return {balls, p};
}

// Crystals are simple, body- or face-centred cubic, hexagonal or diamond; with vacancies, some with mixed radii.
Made crystal(Dice& dice) {
  const double p = dice.probe(), r = dice.radius();
  const int kind = dice.count(0, 4), cells = dice.count(1, 2);
  const double fit = r + p;
  const double ties[] = {2 * fit / std::sqrt(3.0), fit * std::sqrt(2.0), 2 * fit, 2 * r, 1.7, 3.567, fit};
  const double a = dice.chance(0.6) ? ties[dice.count(0, 6)] : dice.between(1.2, 4.0);
  const double keep = dice.chance(0.5) ? dice.between(0.4, 0.95) : 1.0;
  const bool mixed = dice.chance(0.25);
  std::vector<glm::dvec3> basis = {{0, 0, 0}};
  glm::dvec3 cell(a);
  if (kind == 1) basis.push_back({0.5, 0.5, 0.5});
  if (kind == 2 || kind == 4) basis.insert(basis.end(), {{0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}});
  if (kind == 4)
    for (int n = 0; n < 4; ++n) basis.push_back(basis[n] + 0.25);
  if (kind == 3) {
    cell = {a, a * std::sqrt(3.0), a * std::sqrt(8.0 / 3)};
    basis = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 1.0 / 6, 0.5}, {0, 2.0 / 3, 0.5}};
  }
  Balls balls;
  const int reach = cells + 1;
  for (int x = 0; x < reach; ++x)
    for (int y = 0; y < reach; ++y)
      for (int z = 0; z < (kind == 4 ? 1 : reach); ++z)
        for (const glm::dvec3& b : basis) {
          const glm::dvec3 at = (glm::dvec3(x, y, z) + b) * cell;
          const bool inside = at.x <= cells * cell.x + 0.01 && at.y <= cells * cell.y + 0.01;
          if (inside && dice.chance(keep)) balls.push_back({at, mixed ? dice.radius() : r});
        }
  if (balls.empty()) balls.push_back({{0, 0, 0}, r});
  return {balls, p};
}

Made ring_or_helix(Dice& dice) {
  const double p = dice.small_probe(), r = dice.radius(), fit = r + p;
  const int count = dice.count(3, 24);
  const bool helix = dice.chance(0.5);
  const double edges[] = {fit, fit * std::sqrt(2.0), fit * std::sqrt(3.0), 2 * fit, 2 * r, 1.5};
  const double edge = dice.chance(0.6) ? edges[dice.count(0, 5)] : dice.between(0.8, 2.0) * r;
  if (!helix) {
    Balls balls = ring(count, edge, r);
    if (dice.chance(0.3)) balls.push_back({{0, 0, dice.chance(0.5) ? 0.0 : fit}, dice.radius()});
    return {balls, p};
  }
  const double radius = dice.chance(0.5) ? fit : dice.between(0.5, 2.0) * r;
  const int per_turn = dice.count(3, 7);
  const double rise = dice.chance(0.5) ? 2 * fit / per_turn : dice.between(0.3, 1.5);
  Balls balls;
  for (int n = 0; n < count; ++n) {
    const double turn = 2 * kPi * n / per_turn;
    balls.push_back({{radius * std::cos(turn), radius * std::sin(turn), rise * n}, r});
  }
  return {balls, p};
}

// Balls touch others from outside or inside, as vdW or as SAS spheres, or lie in them.
Made tangent(Dice& dice) {
  const double p = dice.small_probe();
  Balls balls = {{{0, 0, 0}, dice.radius()}};
  for (int n = 0, count = dice.count(1, 12); n < count; ++n) {
    const Ball onto = balls[static_cast<std::size_t>(dice.count(0, n))];
    const double r = dice.chance(0.2) ? onto.radius * dice.between(0.2, 0.9) : dice.radius();
    const double sum = onto.radius + r;
    const double distances[] = {
        sum, sum + 2 * p, std::abs(onto.radius - r), 0.0, std::abs(onto.radius - r) * dice.unit(), sum * dice.unit()};
    const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, dice.direction()};
    balls.push_back({onto.center + distances[dice.count(0, 5)] * axes[dice.count(0, 3)], r});
  }
  return {balls, p};
}

// Circles are exactly as large as the probe, collinear and in a plane.
Made critical_spindles(Dice& dice) {
  const double p = dice.small_probe(), r = dice.radius(), fit = r + p;
  const double d = 2 * std::sqrt(fit * fit - p * p);
  const int kind = dice.count(0, 3);
  if (kind == 0) return {collinear(dice.count(2, 6), d, r), p};
  if (kind == 1) return {ring(dice.count(3, 6), d, r), p};
  if (kind == 2) return {lattice(dice.count(1, 3), dice.count(1, 3), dice.count(1, 2), d, r), p};
  return {dice.chance(0.5) ? tetrahedron(d, r) : octahedron(d, r), p};
}

Made carbon(Dice& dice) {
  const double p = dice.small_probe(), r = dice.chance(0.7) ? 1.7 : dice.radius();
  switch (dice.count(0, 3)) {
    case 0:
      return {c60(dice.chance(0.5) ? 1.45 : dice.between(1.0, 3.0), r), p};
    case 1:
      return {nanotube(5, 5, 2, r), p};
    case 2:
      return {dice.chance(0.5) ? nanotube(6, 0, 2, r) : nanotube(4, 2, 1, r), p};
    default:
      return {graphene(dice.count(1, 3), r), p};
  }
}

Made few_with_large_probe(Dice& dice) {
  const double probes[] = {5.0, 10.0, 20.0, 50.0, 100.0};
  Balls balls;
  const double grid = dice.chance(0.5) ? 1.0 : 0.5;
  for (int n = 0, count = dice.count(3, 7); n < count; ++n) {
    const glm::dvec3 x = dice.in_cube(4);
    balls.push_back({glm::floor(x / grid) * grid, dice.chance(0.5) ? 1.5 : dice.radius()});
  }
  return {balls, probes[dice.count(0, 4)]};
}

Made grid_gas(Dice& dice) {
  const double p = dice.chance(0.3) ? 1.5 : dice.small_probe();
  const double step = dice.chance(0.5) ? 1.0 : 0.5;
  return {gas(dice.bits()(), dice.count(4, 40), dice.between(4, 12), 1.0, dice.between(1.0, 2.5), step), p};
}

Made symmetric(Dice& dice) {
  const int fold = dice.count(2, 6);
  const double p = dice.small_probe();
  Balls part, balls;
  for (int n = 0, count = dice.count(1, 5); n < count; ++n) part.push_back({dice.in_cube(4), dice.radius()});
  if (dice.chance(0.3)) part.push_back({{0, 0, dice.between(-4, 4)}, dice.radius()});
  for (int copy = 0; copy < fold; ++copy) {
    const double c = std::cos(2 * kPi * copy / fold), s = std::sin(2 * kPi * copy / fold);
    for (const Ball& b : part)
      balls.push_back({{c * b.center.x - s * b.center.y, s * b.center.x + c * b.center.y, b.center.z}, b.radius});
  }
  return {balls, p};
}

// Each of a few atoms exists several times, almost at one place.
Made nearly_coincident(Dice& dice) {
  const double p = dice.small_probe();
  const double spread = std::pow(10.0, dice.between(-13, -4)), blur = dice.chance(0.5) ? spread : 0.0;
  Balls balls;
  for (int n = 0, sites = dice.count(1, 6); n < sites; ++n) {
    const Ball site{dice.in_cube(2.5), dice.radius()};
    for (int k = 0, count = dice.count(1, 10); k < count; ++k)
      balls.push_back({site.center + dice.in_cube(spread), site.radius + blur * dice.between(-1, 1)});
  }
  return {balls, p};
}

std::vector<Recipe> recipes_of_ties() {
  return {{"one-point", through_one_point},
          {"two-points", through_two_points},
          {"tube", tube},
          {"solid", solid},
          {"crystal", crystal},
          {"ring-helix", ring_or_helix},
          {"tangent", tangent},
          {"spindle", critical_spindles},
          {"carbon", carbon},
          {"large-probe", few_with_large_probe},
          {"grid-gas", grid_gas},
          {"symmetric", symmetric},
          {"coincident", nearly_coincident}};
}

// A family's place is part of its cases' seeds: new ones come last.
const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = [] {
    std::vector<Recipe> list = recipes_of_ties();
    for (const auto& more : {touching_recipes(), pattern_recipes()}) list.insert(list.end(), more.begin(), more.end());
    return list;
  }();
  return all;
}

}  // namespace

const std::vector<std::string>& family_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Recipe& recipe : recipes()) list.push_back(recipe.name);
    return list;
  }();
  return names;
}

FamilyCase family_case(const std::string& family, std::uint32_t n) {
  for (std::uint32_t f = 0; f < recipes().size(); ++f) {
    if (recipes()[f].name != family) continue;
    Dice dice(f, n);
    Made drawn = recipes()[f].make(dice);
    FamilyCase made{family, std::move(drawn.balls), drawn.probe_radius, 0.0};
    if (n % 2 == 1) made.jitter = std::pow(10.0, dice.between(-12, -3));
    for (Ball& b : made.balls) b.center += dice.in_cube(made.jitter);
    if (n % 4 >= 2) {
      made.balls = rotated(made.balls, random_rotation(dice.bits()));
      made.balls = permuted(made.balls, random_order(made.balls.size(), dice.bits()));
    }
    return made;
  }
  return {};
}

CorpusCase read_corpus(const std::string& path) {
  std::ifstream file(path);
  CorpusCase entry;
  for (std::string line; std::getline(file, line);) {
    Ball b;
    if (std::sscanf(line.c_str(), "# probe %lf", &entry.probe_radius) == 1) continue;
    if (std::sscanf(line.c_str(), "%lf %lf %lf %lf", &b.center.x, &b.center.y, &b.center.z, &b.radius) == 4)
      entry.balls.push_back(b);
  }
  return entry;
}

}  // namespace meniscus::testing
