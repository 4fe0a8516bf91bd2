// SPDX-License-Identifier: BSD-3-Clause
// Atoms within others, found at once or from pairs that are kept from frame to frame, are those that a look at all
// pairs finds; what they cost, and atoms on a line, is in proportion to the input.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/math/ball.h"
#include "core/math/double_geometry.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {
namespace {

/// Returns many small balls among large ones.
std::vector<Ball> crowd_of_balls(std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, 14.0), radius(0.3, 2.0);
  std::vector<Ball> balls;
  for (int n = 0; n < 600; ++n) balls.push_back({{place(random), place(random), place(random)}, radius(random)});
  return balls;
}

// Atoms move a little, together or apart, or far, or change their radii or their number.
TEST(SwallowedAtoms, AreThoseOfEachFrameAnew) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  std::vector<Ball> balls = crowd_of_balls(random);
  SwallowedAtoms kept;
  std::size_t swallowed = 0, changes = 0;
  std::vector<bool> before;
  for (int frame = 0; frame < 120; ++frame) {
    const double way = frame % 30 == 29 ? 5.0 : frame % 10 == 9 ? 0.6 : 0.05;
    for (Ball& ball : balls) ball.center += way * glm::dvec3(one(random), one(random), one(random));
    if (frame % 17 == 16) balls[static_cast<std::size_t>(frame)].radius *= 1.5;
    if (frame == 60) balls.resize(500);
    const std::vector<bool> expected = swallowed_atoms(balls);
    ASSERT_EQ(kept.of(balls), expected) << frame;
    swallowed += static_cast<std::size_t>(std::ranges::count(expected, true));
    changes += before.size() == expected.size() && expected != before;
    before = expected;
  }
  EXPECT_GT(swallowed, 1000u);
  EXPECT_GT(changes, 60u);
  EXPECT_TRUE(kept.of({}).empty());
}

/// Finds swallowed atoms by all pairs, large atoms first; protruding: the most by which one protrudes.
std::vector<bool> swallowed_by_all_pairs(const std::vector<Ball>& balls, double& protruding) {
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return balls[a].radius > balls[b].radius; });
  std::vector<bool> swallowed(balls.size(), false);
  protruding = 0.0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Ball& held = balls[order[n]];
    double slack = -std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < n; ++m)
      if (const Ball& by = balls[order[m]]; !swallowed[order[m]])
        slack = std::max(slack, by.radius - held.radius - glm::distance(held.center, by.center));
    if (slack + geometry::kMergeDistance < 0) continue;
    swallowed[order[n]] = true;
    protruding = std::max(protruding, std::min(-slack, geometry::kMergeDistance));
  }
  return swallowed;
}

// Balls lie in one place, almost in one place, within others, and in chains of which each is near the next only.
TEST(SwallowedAtoms, AreThoseOfAllPairs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  std::size_t held = 0, stick_out = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double spread = std::pow(10.0, -9 + trial % 10), size = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 1e-6 : 0.5;
    std::vector<Ball> balls;
    for (int n = 0; n < 80; ++n)
      balls.push_back({spread * glm::dvec3(one(random), one(random), one(random)), 1.5 + size * one(random)});
    for (int n = 0; n < 20; ++n) balls.push_back(balls[static_cast<std::size_t>(n)]);
    double expected = 0.0, protruding = 0.0;
    const std::vector<bool> all = swallowed_by_all_pairs(balls, expected);
    ASSERT_EQ(swallowed_atoms(balls, &protruding), all) << trial;
    ASSERT_EQ(protruding, expected) << trial;
    held += static_cast<std::size_t>(std::ranges::count(all, true));
    stick_out += expected > 0.0;
  }
  EXPECT_GT(held, 15000u);
  EXPECT_GT(stick_out, 50u);
}

double seconds_used() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}
long peak_kilobytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

// A conversion that failed writes all atoms at 0, 0, 0: pairs of them would be gigabytes.
TEST(SwallowedAtoms, InOnePlaceCostNoMoreThanTheirNumber) {
  for (const double spread : {0.0, 1e-8}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    std::vector<Ball> balls;
    for (int n = 0; n < 20000; ++n)
      balls.push_back({spread * glm::dvec3(one(random), one(random), one(random)), n % 3 == 0 ? 1.7 : 1.5});
    const long memory = peak_kilobytes();
    const double time = seconds_used();
    const std::vector<bool> swallowed = swallowed_atoms(balls);
    SwallowedAtoms kept;
    for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(kept.of(balls), swallowed);
    EXPECT_EQ(std::ranges::count(swallowed, false), 1) << spread;
    EXPECT_LT(peak_kilobytes() - memory, 200'000) << spread;
    EXPECT_LT(seconds_used() - time, 20.0) << spread;
  }
}

// Each atom of a line overlaps all others; of N² / 2 circles its neighbours leave N - 1.
TEST(AtomsOnALine, HaveACircleBetweenNeighborsAndCostNoMoreThanTheirPairs) {
  std::vector<Ball> balls;
  ReducedSurface rs;
  double seconds[2];
  for (const int count : {2000, 4000}) {
    balls.clear();
    for (int n = 0; n < count; ++n) balls.push_back({{2.0 * n / count, 0.0, 0.0}, 1.7});
    const double time = seconds_used();
    rs = enumerate_reduced_surface(balls, 1.4);
    seconds[count / 4000] = seconds_used() - time;
  }
  EXPECT_LT(seconds[1], 6.0 * seconds[0]);  // pairs are 4 times as many, triples 8 times
  ASSERT_EQ(rs.arcs.size(), balls.size() - 1);
  for (std::uint32_t n = 0; n < rs.arcs.size(); ++n) EXPECT_EQ(rs.arcs[n], (RsArc{n, n + 1, kNone, kNone}));
  EXPECT_EQ(rs.exact_within, 0.0);
}

}  // namespace
}  // namespace meniscus
