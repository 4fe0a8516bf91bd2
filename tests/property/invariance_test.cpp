// SPDX-License-Identifier: BSD-3-Clause
// Changes that leave a molecule the same keep its surface: motions, mirrors, scale, atom order, doubled atoms.
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/topology.h"

namespace meniscus::testing {
namespace {

// Rounding of coordinates around 1,000 Å is 1e-13 Å; where spheres barely touch, its square root counts.
constexpr double kRelative = 1e-9;

void expect_same(const Surface& a, const Surface& b, double scale = 1.0) {
  EXPECT_EQ(topology_of(a), topology_of(b));
  EXPECT_NEAR(a.area * scale * scale, b.area, kRelative * b.area);
  EXPECT_NEAR(a.volume * scale * scale * scale, b.volume, kRelative * b.volume);
}

class Degenerate : public ::testing::TestWithParam<std::size_t> {
 protected:
  NamedBalls molecule_ = degenerate_molecules()[GetParam()];
  Surface original_ = compute_surface_cpu(molecule_.balls, molecule_.probe_radius);
  std::mt19937 random_{static_cast<std::uint32_t>(GetParam())};

  void expect_unchanged(const Balls& balls) {
    expect_same(original_, compute_surface_cpu(balls, molecule_.probe_radius));
  }
};

TEST_P(Degenerate, Rotated100TimesAndShiftedBy1000Angstrom) {
  for (int n = 0; n < 100 && !HasFailure(); ++n) {
    const Balls turned = rotated(molecule_.balls, random_rotation(random_));
    expect_unchanged(turned);
    expect_unchanged(translated(turned, {1000, -1000, 1000}));
  }
}

TEST_P(Degenerate, AtomsInAnyOrder) {
  for (int n = 0; n < 20 && !HasFailure(); ++n)
    expect_unchanged(permuted(molecule_.balls, random_order(molecule_.balls.size(), random_)));
}

TEST_P(Degenerate, Mirrored) { expect_unchanged(mirrored(molecule_.balls)); }

TEST_P(Degenerate, AtomsDoubled) {
  Balls doubled = molecule_.balls;
  doubled.insert(doubled.begin(), molecule_.balls.begin(), molecule_.balls.end());
  doubled.push_back({doubled[0].center, 0.5 * doubled[0].radius});
  expect_unchanged(doubled);
}

TEST_P(Degenerate, Scaled) {
  for (const double k : {0.5, 1.7, 4.0})
    expect_same(original_, compute_surface_cpu(scaled(molecule_.balls, k), k * molecule_.probe_radius), k);
}

TEST_P(Degenerate, JitteredByAnyAmount) {
  for (double step = 1e-3; step > 1e-14; step /= 10) {
    std::uniform_real_distribution<double> shift(-step, step);
    for (int n = 0; n < 5; ++n) {
      Balls balls = molecule_.balls;
      for (Ball& b : balls) b.center += glm::dvec3(shift(random_), shift(random_), shift(random_));
      EXPECT_NO_THROW(compute_surface_cpu(balls, molecule_.probe_radius)) << step;
    }
  }
}

std::string case_name(const ::testing::TestParamInfo<std::size_t>& parameter) {
  std::string name = degenerate_molecules()[parameter.param].name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Degenerate, ::testing::Range(std::size_t{0}, degenerate_molecules().size()), case_name);

TEST(Ubiquitin, MovedReorderedAndMirrored) {
  const Balls balls = ubiquitin();
  const Surface original = compute_surface_cpu(balls, kWater);
  std::mt19937 random(1);
  for (int n = 0; n < 5; ++n) {
    const Balls turned = rotated(balls, random_rotation(random));
    expect_same(original, compute_surface_cpu(turned, kWater));
    expect_same(original, compute_surface_cpu(translated(turned, {-1000, 1000, 1000}), kWater));
  }
  expect_same(original, compute_surface_cpu(permuted(balls, random_order(balls.size(), random)), kWater));
  expect_same(original, compute_surface_cpu(mirrored(balls), kWater));
  expect_same(original, compute_surface_cpu(scaled(balls, 3.0), 3 * kWater), 3.0);
}

TEST(Ubiquitin, ClosedForEveryProbe) {
  const Balls balls = ubiquitin();
  double volume = compute_surface_cpu(balls, 0.0).volume;
  for (double p = 0.2; p < 8.1; p += p < 3 ? 0.2 : 1.0) {
    const Surface s = compute_surface_cpu(balls, p);
    EXPECT_TRUE(s.certificate.closed) << p;
    EXPECT_GT(s.volume, volume) << "a larger probe reaches less, p = " << p;
    volume = s.volume;
  }
}

TEST(Enterotoxin, ShiftedBy1000Angstrom) {
  const Balls balls = enterotoxin();
  expect_same(compute_surface_cpu(balls, kWater), compute_surface_cpu(translated(balls, {1000, 1000, -1000}), kWater));
}

}  // namespace
}  // namespace meniscus::testing
