// SPDX-License-Identifier: BSD-3-Clause
// Velocities of the surface against how its distance function changes when the atoms move.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/tessellate.h"
#include "core/mesh/velocity.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

constexpr double kMoment = 1e-6;  // in frames

using Velocities = std::vector<glm::dvec3>;

Velocities random_velocities(std::size_t count, double most) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(-most, most);
  Velocities velocities(count);
  for (glm::dvec3& v : velocities) v = {along(random), along(random), along(random)};
  return velocities;
}

Balls moved(Balls balls, const Velocities& velocity, double time) {
  for (std::size_t n = 0; n < balls.size(); ++n) balls[n].center += velocity[n] * time;
  return balls;
}

/// The speed of the surface along its normal at a point of it. dist(x, A) falls by 1 an Å outwards and is p on the
/// surface, so its change in time is the way the surface moves outwards.
class NormalSpeed {
 public:
  NormalSpeed(const Balls& balls, double probe, const Velocities& velocity)
      : before_(moved(balls, velocity, -kMoment), probe), behind_(moved(balls, velocity, kMoment), probe) {}
  double operator()(const glm::dvec3& x) const {
    return (behind_.nearest(x).distance - before_.nearest(x).distance) / (2.0 * kMoment);
  }

 private:
  SphereTracer before_, behind_;
};

std::set<std::uint32_t> sharp_vertices(const TriangleMesh& mesh) {
  std::set<std::uint32_t> sharp;
  for (const std::uint32_t corner : mesh.sharp_corners) sharp.insert(mesh.triangles[corner / 3][corner % 3]);
  return sharp;
}

struct Agreement {
  std::size_t smooth = 0, wrong = 0, sharp = 0, sharp_wrong = 0;
};

Agreement agreement(const Balls& balls, double probe, double speed, double factor = 1.0) {
  const Velocities atoms = random_velocities(balls.size(), speed);
  const Surface surface = compute_surface_cpu(balls, probe);
  const TriangleMesh mesh = tessellate(surface, {0.05, false});
  const Velocities velocity = vertex_velocities(surface, mesh, atoms);
  const NormalSpeed truth(balls, probe, atoms);
  const std::set<std::uint32_t> sharp = sharp_vertices(mesh);
  Agreement found;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (sharp.contains(v)) continue;
    ++found.smooth;
    const double along = factor * glm::dot(velocity[v], mesh.normals[v]);
    found.wrong += std::abs(along - truth(mesh.positions[v])) > 1e-4 * speed + 1e-4 * std::abs(along);
  }
  const SurfaceVelocity exact(surface, atoms);
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n) {
    const std::uint32_t t = mesh.sharp_corners[n] / 3, v = mesh.triangles[t][mesh.sharp_corners[n] % 3];
    const glm::dvec3 own = exact.at(mesh.kind[t], mesh.patch[t], mesh.positions[v], mesh.sharp_corner_normals[n]);
    ++found.sharp;
    found.sharp_wrong += std::abs(glm::dot(mesh.sharp_corner_normals[n], own - velocity[v])) > 0.1 * speed;
  }
  return found;
}

void expect_agreement(const Balls& balls, double probe = kWater) {
  const Agreement found = agreement(balls, probe, 0.1);
  EXPECT_GT(found.smooth, 100u);
  EXPECT_EQ(found.wrong, 0u) << "of " << found.smooth;
  EXPECT_LE(found.sharp_wrong, found.sharp / 20) << "of " << found.sharp;
  EXPECT_GT(agreement(balls, probe, 0.1, 1.01).wrong, found.smooth / 2);  // The comparison can fail.
}

TEST(SurfaceVelocity, OfARing) { expect_agreement(two_atoms(3.6, 1.7, 1.5)); }
TEST(SurfaceVelocity, OfASpindle) { expect_agreement(two_atoms(5.8, 1.7, 1.5)); }
TEST(SurfaceVelocity, OfThreeAtoms) {
  expect_agreement({{{0, 0, 0}, 1.7}, {{3.9, 0.1, 0}, 1.55}, {{1.7, 3.6, 0.4}, 1.52}});
}
TEST(SurfaceVelocity, OfCutProbes) {
  expect_agreement({{{0, 0, 0}, 1.7}, {{4.8, 0.1, 0}, 1.7}, {{2.3, 4.2, 0.2}, 1.7}, {{2.4, 1.5, 4.0}, 1.6}});
}
TEST(SurfaceVelocity, OfAGas) { expect_agreement(gas(3, 40, 11.0, 1.2, 2.0)); }

TEST(SurfaceVelocity, OfVanDerWaalsSpheres) {
  const Balls balls = two_atoms(2.0);
  const Velocities atoms{{0.1, 0.2, 0.3}, {-0.1, 0.0, 0.2}};
  const Surface surface = compute_surface_cpu(balls, 0.0);
  const SurfaceVelocity velocity(surface, atoms);
  for (std::uint32_t n = 0; n < 2; ++n)
    EXPECT_EQ(velocity.at(PatchKind::convex, n, balls[n].center, {1, 0, 0}), atoms[n]);
}

TEST(SurfaceVelocity, RigidMotionStaysRigid) {
  const Balls balls = gas(7, 30, 10.0, 1.2, 2.0);
  const glm::dvec3 shift(0.3, -0.1, 0.2), turn(0.02, 0.05, -0.03);
  Velocities atoms;
  for (const Ball& ball : balls) atoms.push_back(shift + glm::cross(turn, ball.center));
  const Surface surface = compute_surface_cpu(balls, kWater);
  const TriangleMesh mesh = tessellate(surface, {0.05, false});
  const SurfaceVelocity velocity(surface, atoms);
  const std::set<std::uint32_t> sharp = sharp_vertices(mesh);
  std::size_t curved = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.kind[t] == PatchKind::convex) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (sharp.contains(v)) continue;
      const glm::dvec3 x = mesh.positions[v], found = velocity.at(mesh.kind[t], mesh.patch[t], x, mesh.normals[v]);
      ASSERT_LT(glm::distance(found, shift + glm::cross(turn, x)), 1e-6) << int(mesh.kind[t]) << ' ' << t;
      ++curved;
    }
  }
  EXPECT_GT(curved, 1000u);
}

TEST(SurfaceVelocity, RollingProbesEndAsTheFixedOnesMove) {
  const Balls balls = gas(7, 30, 10.0, 1.2, 2.0);
  const Surface surface = compute_surface_cpu(balls, kWater);
  const SurfaceVelocity velocity(surface, random_velocities(balls.size(), 0.1));
  std::size_t ends = 0;
  for (std::uint32_t n = 0; n < surface.toroidal.size(); ++n) {
    for (const std::uint32_t probe : surface.toroidal[n].probe) {
      if (probe == kNone) continue;
      const glm::dvec3 fixed = velocity.of_probe(probe);
      if (glm::length(fixed) > 1.0) continue;  // The probe may be held back.
      EXPECT_LT(glm::distance(velocity.of_rolling_probe(n, surface.concave[probe].center), fixed), 1e-6) << n;
      ++ends;
    }
  }
  EXPECT_GT(ends, 50u);
}

TEST(SurfaceVelocity, AProbeThatSlipsThroughStaysBelowItsLimit) {
  // Three atoms so far apart that the probe just fits between them: pulled apart, it would fall at any speed.
  const double reach = 1.7 + kWater, side = reach * std::sqrt(3.0) * (1.0 - 1e-9);
  Balls balls;
  Velocities atoms;
  for (int n = 0; n < 3; ++n) {
    const glm::dvec3 outward(std::cos(2.0943951 * n), std::sin(2.0943951 * n), 0.0);
    balls.push_back({outward * side / std::sqrt(3.0), 1.7});
    atoms.push_back(outward * 0.1);
  }
  const Surface surface = compute_surface_cpu(balls, kWater);
  ASSERT_FALSE(surface.concave.empty());
  const SurfaceVelocity velocity(surface, atoms);
  EXPECT_NEAR(glm::length(velocity.of_probe(0)), 2.0 * kWater, 0.2);
}

TEST(SurfaceVelocity, WantsOneForEachAtom) {
  const Surface surface = compute_surface_cpu(two_atoms(3.6), kWater);
  EXPECT_THROW(SurfaceVelocity(surface, Velocities(3)), Error);
}

}  // namespace
}  // namespace meniscus::testing
