// SPDX-License-Identifier: BSD-3-Clause
// Random gases of balls, ties included: always closed, with the volume, points and areas of an oracle.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"
#include "tests/support/sampled_volume.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

PatchSample sample_surface(const Surface& s, PatchKind kind, std::uint32_t patch, std::mt19937& random) {
  return kind == PatchKind::toroidal ? sample_circle(s, patch, random) : sample_patch(s, kind, patch, random);
}

// Checks that points of a patch by its tables lie on the surface, and that points well off it, on the same sphere or
// torus, do not. Returns the number of points.
int check_points(const Surface& s, const SphereTracer& oracle, int per_kind, double tolerance, std::mt19937& random) {
  int looked_at = 0;
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
    const std::size_t count = patch_count(s, kind);
    if (count == 0 || (kind != PatchKind::convex && s.probe_radius == 0)) continue;
    for (int n = 0; n < per_kind; ++n) {
      const auto patch = static_cast<std::uint32_t>(random() % count);
      const PatchSample sample = sample_surface(s, kind, patch, random);
      const double off =
          s.probe_radius > 0 ? oracle.nearest(sample.point).distance - s.probe_radius : oracle.outside(sample.point);
      ++looked_at;
      if (sample.inside) {
        EXPECT_NEAR(off, 0.0, tolerance) << "kind " << int(kind) << ", patch " << patch;
      } else if (sample.clearance > 0.05) {
        EXPECT_GT(std::abs(off), 1e-6) << "kind " << int(kind) << ", patch " << patch;
      }
    }
  }
  return looked_at;
}

void check_gas(std::uint32_t n, std::mt19937& random) {
  SCOPED_TRACE("gas " + std::to_string(n));
  const GasCase gas = gas_case(n);
  const Surface s = compute_surface_cpu(gas.balls, gas.probe_radius);
  // Touching counts as overlapping, for lone points exist on a grid where a probe would just fit.
  Balls grown = gas.balls;
  if (gas.on_grid)
    for (Ball& b : grown) b.radius += 1e-8;
  const SphereTracer oracle(grown, gas.probe_radius, 0.01);
  const VolumeEstimate volume = sampled_volume(gas.balls, gas.probe_radius, oracle, 12, random);
  EXPECT_NEAR(s.volume, volume.value, 5 * volume.error + 1e-9) << "off by so much of " << volume.error;
  // A change of 1e-8 Å moves a probe by its square root where spheres touch.
  EXPECT_GT(check_points(s, oracle, 60, gas.on_grid ? 1e-3 : 1e-6, random), 0);
}

class Gas : public ::testing::TestWithParam<std::uint32_t> {};

constexpr std::uint32_t kCasesPerTest = 50;

TEST_P(Gas, IsClosedAndAsTheOracleSays) {
  std::mt19937 random(GetParam());
  for (std::uint32_t n = GetParam(); n < GetParam() + kCasesPerTest; ++n) check_gas(n, random);
}

// Cases have four and more probes through one point, circles exactly as large as the probe, probes in the plane of
// their atoms; in 4260 a piece of two probes' circle lies deep in one patch and next to the other.
TEST(GasesWithTies, ThatAreHardestToClose) {
  std::mt19937 random(6);
  for (const std::uint32_t n :
       {823u, 927u, 1242u, 1956u, 2760u, 2922u, 3417u, 3453u, 3603u, 3786u, 3942u, 4260u, 4878u, 5793u, 5829u, 5991u})
    check_gas(n, random);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Gas, ::testing::Range(0u, 500u, kCasesPerTest));

TEST(Ubiquitin, TenThousandPointsOfThePatchTablesAreOnTheSurface) {
  const Balls balls = ubiquitin();
  const Surface s = compute_surface_cpu(balls, kWater);
  const SphereTracer oracle(balls, kWater, 0.01);
  std::mt19937 random(3);
  int on = 0, off = 0;
  while (on < 10000 || off < 10000) {
    const auto kind = static_cast<PatchKind>(random() % 3);
    const PatchSample sample =
        sample_surface(s, kind, static_cast<std::uint32_t>(random() % patch_count(s, kind)), random);
    const double distance = oracle.nearest(sample.point).distance - kWater;
    if (sample.inside && on < 10000) {
      ++on;
      ASSERT_NEAR(distance, 0.0, 1e-6) << "kind " << int(kind);
    } else if (!sample.inside && sample.clearance > 0.01 && off < 10000) {
      ++off;
      ASSERT_GT(std::abs(distance), 1e-6) << "kind " << int(kind);
    }
  }
}

TEST(Ubiquitin, VolumeBySamplingTheOracle) {
  const Balls balls = ubiquitin();
  std::mt19937 random(4);
  for (const double p : {0.0, 0.6, 1.4, 3.0}) {
    const SphereTracer oracle(balls, p, 0.01);
    const VolumeEstimate volume = sampled_volume(balls, p, oracle, 50, random);
    EXPECT_NEAR(compute_surface_cpu(balls, p).volume, volume.value, 5 * volume.error) << p;
    EXPECT_LT(volume.error, 2e-3 * volume.value);
  }
}

}  // namespace
}  // namespace meniscus::testing
