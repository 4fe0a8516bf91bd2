// SPDX-License-Identifier: BSD-3-Clause
// The GPU finds the same primitives as the CPU: degenerate molecules as they are and turned, gases with ties, proteins.
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/gpu/egl_context.h"
#include "core/queries/surface_object.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

class GpuSurface : public ::testing::Test {
 protected:
  void expect_equal(const Balls& balls, double probe_radius) {
    const Surface surface = attempt(balls, probe_radius);
    EXPECT_TRUE(surface.certificate.closed);
    const Surface expected = compute_surface_cpu(balls, probe_radius);
    EXPECT_EQ(surface.certificate.exact_within, expected.certificate.exact_within);
    const std::vector<std::string> different = differences(expected, surface);
    EXPECT_TRUE(different.empty()) << different.size() << " differences, first: " << different.front();
  }

  Surface attempt(const Balls& balls, double probe_radius) {
    StageClock clock;
    return attempt_surface(*engine_, balls, probe_radius, clock);
  }

  EglContext context_;
  std::unique_ptr<ReducedSurfaceEngine> engine_ = make_gpu_engine(context_);
};

TEST_F(GpuSurface, DegenerateMolecules) {
  std::mt19937 random(5);
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    expect_equal(molecule.balls, molecule.probe_radius);
    for (int n = 0; n < 4; ++n)
      expect_equal(translated(rotated(molecule.balls, random_rotation(random)), {1000.0 * n, 0, -1000}),
                   molecule.probe_radius);
  }
}

TEST_F(GpuSurface, Gases) {
  for (std::uint32_t n = 0; n < 200; ++n) {
    SCOPED_TRACE("gas " + std::to_string(n));
    const GasCase gas = gas_case(n);
    expect_equal(gas.balls, gas.probe_radius);
  }
}

TEST_F(GpuSurface, Proteins) {
  for (const double p : {0.0, 0.5, 1.4, 3.0}) expect_equal(ubiquitin(), p);
  const Balls balls = enterotoxin();
  expect_equal(balls, kWater);
  expect_equal(translated(balls, {1000, -1000, 1000}), kWater);
}

// Nothing of one molecule stays for the next, be it larger or smaller.
TEST_F(GpuSurface, MoleculesInTurn) {
  for (int turn = 0; turn < 2; ++turn) {
    expect_equal(ubiquitin(), kWater);
    expect_equal(enterotoxin(), kWater);
    expect_equal(degenerate_molecules().front().balls, kWater);
  }
}

TEST_F(GpuSurface, NoAtoms) { EXPECT_TRUE(attempt({}, kWater).components.empty()); }

}  // namespace
}  // namespace meniscus::testing
