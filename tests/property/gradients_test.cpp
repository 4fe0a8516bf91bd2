// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of areas and volumes: closed forms, differences of high order, and invariance under motions of the whole.
#include "core/surface/measure.h"

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

struct Quantity {
  const char* name;
  double (*value)(const Surface&);
  Gradient (*gradient)(const Surface&);
};

double total_of(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// Returns the solvent-accessible volume, as the volume of the grown balls.
double accessible_volume(const Surface& surface) {
  Balls grown = surface.atoms;
  for (Ball& ball : grown) ball.radius += surface.probe_radius;
  return compute_surface_cpu(grown, 0.0).volume;
}

const std::array<Quantity, 4> kQuantities{
    {{"area", [](const Surface& s) { return s.area; }, area_gradient},
     {"volume", [](const Surface& s) { return s.volume; }, volume_gradient},
     {"accessible area", [](const Surface& s) { return total_of(atom_areas(s).accessible); },
      [](const Surface& s) { return accessible_area_gradient(s); }},
     {"accessible volume", accessible_volume, accessible_volume_gradient}}};

/// Returns numbers of patches: a difference along a way is wrong where patches come or go.
std::array<std::size_t, 6> figure_of(const Surface& s) {
  return {s.faces.size(),    s.borders.size(),  s.concave.size(),
          s.toroidal.size(), s.vertices.size(), s.components.size()};
}

/// Returns the central difference of eighth order of a molecule's number when its balls move along `motion`, Å; nothing
/// where patches come or go.
std::optional<double> one_difference(const Balls& balls, double probe, const std::vector<glm::dvec3>& motion,
                                     double (*value)(const Surface&), double step) {
  constexpr std::array<double, 4> kWeights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const auto at = [&](double t) {
    Balls moved = balls;
    for (std::size_t a = 0; a < moved.size(); ++a) moved[a].center += t * motion[a];
    return compute_surface_cpu(moved, probe);
  };
  const std::array<std::size_t, 6> figure = figure_of(at(0.0));
  double result = 0;
  for (int n = 1; n <= 4; ++n) {
    const Surface ahead = at(n * step), behind = at(-n * step);
    if (figure_of(ahead) != figure || figure_of(behind) != figure) return {};
    result += kWeights[static_cast<std::size_t>(n - 1)] * (value(ahead) - value(behind)) / step;
  }
  return result;
}

/// Returns the difference of two steps; nothing where they disagree, next to a place without a derivative.
std::optional<double> difference(const Balls& balls, double probe, const std::vector<glm::dvec3>& motion,
                                 double (*value)(const Surface&), double step) {
  const auto wide = one_difference(balls, probe, motion, value, step),
             narrow = one_difference(balls, probe, motion, value, step / 4);
  if (!wide || !narrow || std::abs(*wide - *narrow) > 1e-7 * (1 + std::abs(*wide))) return {};
  return wide;
}

double change(const Gradient& gradient, const std::vector<glm::dvec3>& motion) {
  double result = 0;
  for (std::size_t a = 0; a < gradient.size(); ++a) result += glm::dot(gradient[a], motion[a]);
  return result;
}

TEST(Gradients, TwoBallsInClosedForm) {
  const double distance = 3.0, extended = kCarbon + kWater;
  const Surface surface = compute_surface_cpu(two_atoms(distance), kWater);
  const double circle = std::sqrt(extended * extended - distance * distance / 4);
  // Caps of height R + d/2 remain.
  EXPECT_NEAR(accessible_area_gradient(surface)[1].x, 2 * kPi * extended, 1e-12);
  EXPECT_NEAR(accessible_volume_gradient(surface)[1].x, kPi * circle * circle, 1e-12);
  // 4 pi r^2 (1 + sin phi) + 2 pi p (2 phi T - 2 p sin phi), sin phi = d / 2R, T = R cos phi.
  const double phi = std::asin(distance / (2 * extended)), by_distance = 1 / (2 * circle);
  const double by_phi =
      4 * kPi * kCarbon * kCarbon * std::cos(phi) +
      2 * kPi * kWater * (2 * circle - 2 * phi * extended * std::sin(phi) - 2 * kWater * std::cos(phi));
  EXPECT_NEAR(area_gradient(surface)[1].x, by_phi * by_distance, 1e-11);
  for (const Quantity& quantity : kQuantities) {
    const Gradient gradient = quantity.gradient(surface);
    EXPECT_LT(glm::length(gradient[0] + gradient[1]), 1e-12) << quantity.name;
    EXPECT_LT(std::hypot(gradient[1].y, gradient[1].z), 1e-12) << quantity.name;
  }
}

TEST(Gradients, AreDifferencesOfGases) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int compared = 0, with_cusps = 0, with_spindles = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const double probe = seed % 4 == 3 ? 0.0 : 0.7 + 0.35 * (seed % 5);
    const Balls balls = gas(seed + 1, 30, 9.0, 1.1, 1.9);
    const Surface surface = compute_surface_cpu(balls, probe);
    std::vector<glm::dvec3> motion(balls.size());
    for (glm::dvec3& v : motion) v = 0.3 * glm::dvec3(normal(random), normal(random), normal(random));
    for (const Quantity& quantity : kQuantities) {
      const auto expected = difference(balls, probe, motion, quantity.value, 5e-4);
      if (!expected) continue;
      ++compared;
      EXPECT_NEAR(change(quantity.gradient(surface), motion), *expected, 2e-7 * (1 + std::abs(*expected)))
          << quantity.name << ", gas " << seed << ", probe " << probe;
      for (const Border& border : surface.borders) with_cusps += border.kind == BorderKind::cusp ? 1 : 0;
      for (const ToroidalPatch& patch : surface.toroidal) with_spindles += surface.spindle(patch) ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 45);
  EXPECT_GT(with_cusps, 100);
  EXPECT_GT(with_spindles, 20);
}

TEST(Gradients, OfAProteinsAtomsOneByOne) {
  const Balls balls = ubiquitin();
  const Surface surface = compute_surface_cpu(balls, kWater);
  std::array<Gradient, 3> gradients;
  for (std::size_t q = 0; q < gradients.size(); ++q) gradients[q] = kQuantities[q].gradient(surface);
  int compared = 0;
  for (const std::size_t a : {3u, 77u, 291u})
    for (int axis = 0; axis < 3; axis += 2) {
      std::vector<glm::dvec3> motion(balls.size(), glm::dvec3(0.0));
      motion[a][axis] = 1.0;
      for (std::size_t q = 0; q < gradients.size(); ++q) {
        const auto expected = difference(balls, kWater, motion, kQuantities[q].value, 1e-3);
        if (!expected) continue;
        ++compared;
        EXPECT_NEAR(gradients[q][a][axis], *expected, 1e-6) << kQuantities[q].name << ", atom " << a;
      }
    }
  EXPECT_GT(compared, 10);
}

TEST(Gradients, MovingOrTurningAllChangesNothing) {
  const Balls balls = ubiquitin();
  const Surface surface = compute_surface_cpu(balls, kWater);
  for (const Quantity& quantity : kQuantities) {
    glm::dvec3 force(0.0), torque(0.0);
    double size = 0;
    const Gradient gradient = quantity.gradient(surface);
    for (std::size_t a = 0; a < balls.size(); ++a) {
      force += gradient[a];
      torque += glm::cross(balls[a].center, gradient[a]);
      size += glm::length(gradient[a]);
    }
    EXPECT_GT(size, 100.0) << quantity.name;
    EXPECT_LT(glm::length(force), 1e-11 * size) << quantity.name;
    EXPECT_LT(glm::length(torque), 1e-9 * size) << quantity.name;
  }
}

TEST(Gradients, WeightsAreThoseOfAtoms) {
  const Balls balls = gas(5, 25, 8.0, 1.2, 1.8);
  const Surface surface = compute_surface_cpu(balls, kWater);
  Gradient together(balls.size(), glm::dvec3(0.0));
  std::vector<double> weights(balls.size());
  for (std::size_t a = 0; a < balls.size(); ++a) {
    std::vector<double> one(balls.size());
    weights[a] = one[a] = 0.1 * static_cast<double>(a) - 1;
    const Gradient gradient = accessible_area_gradient(surface, one);
    for (std::size_t b = 0; b < balls.size(); ++b) together[b] += gradient[b];
  }
  const Gradient gradient = accessible_area_gradient(surface, weights);
  for (std::size_t b = 0; b < balls.size(); ++b) EXPECT_LT(glm::distance(gradient[b], together[b]), 1e-10);
  // One atom's area is compared with a difference.
  const std::size_t watched = 7, moved = 7;
  std::vector<double> one(balls.size());
  one[watched] = 1;
  const auto area_at = [&](double t) {
    Balls there = balls;
    there[moved].center.y += t;
    return atom_areas(compute_surface_cpu(there, kWater)).accessible[watched];
  };
  ASSERT_GT(area_at(0), 0.0);
  const double h = 1e-4;
  EXPECT_NEAR(accessible_area_gradient(surface, one)[moved].y,
              (8 * (area_at(h) - area_at(-h)) - (area_at(2 * h) - area_at(-2 * h))) / (12 * h), 1e-6);
}

TEST(Gradients, AProbeOnFourAtomsHasNone) {
  const Surface surface = compute_surface_cpu(ring(4, 3.4), kWater);  // The atoms make a square.
  ASSERT_FALSE(surface.concave.empty());
  try {
    volume_gradient(surface);
    FAIL();
  } catch (const RequestError& error) {
    EXPECT_NE(std::string(error.what()).find("one probe touches 4 atoms at once ("), std::string::npos) << error.what();
  }
  EXPECT_THROW(area_gradient(surface), RequestError);
  glm::dvec3 force(0.0);
  for (const glm::dvec3& g : accessible_area_gradient(surface)) force += g;
  EXPECT_LT(glm::length(force), 1e-12);
}

}  // namespace
}  // namespace meniscus::testing
