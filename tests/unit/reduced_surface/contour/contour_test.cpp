// SPDX-License-Identifier: BSD-3-Clause
// All balls at once leave of a circle what one ball after the other does, to the last bit, in any number; a circle that
// watched directions rule out is covered; and balls whose circles they do not rule out leave the arcs that all leave.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/math/ball.h"
#include "core/reduced_surface/contour/blockers.h"
#include "core/reduced_surface/contour/contour.h"

namespace meniscus {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(engine_), y = normal(engine_), z = normal(engine_);
    return glm::normalize(glm::dvec3(x, y, z));
  }

 private:
  std::mt19937 engine_;
};

/// Returns up to 70 balls that overlap a first one of radius 3, like SAS balls of a protein.
Blockers surroundings(Random& random, int most) {
  Blockers blockers;
  blockers.restart(9);
  const int count = 1 + static_cast<int>(random.between(0, most));
  for (int n = 0; n < count; ++n) {
    const double radius = random.between(2.6, 3.4);
    blockers.add(random.between(1.2, 3 + radius - 0.01) * random.direction(), radius * radius, 100u + n);
  }
  return blockers;
}

/// Returns the arcs of a circle by one ball after the other, in double precision.
geometry::Remainder one_after_the_other(const Blockers& blockers, std::size_t circle) {
  geometry::Remainder left;
  const double w0 = blockers.first_weight();
  left.begin_contour(geometry::circle_of_two_spheres(blockers[circle].center, w0, blockers[circle].weight), w0,
                     geometry::kUnitRoundoff);
  for (std::size_t n = 0; n < blockers.size() && !left.contour_ended(); ++n)
    if (n != circle) left.block(blockers[n], blockers.label(n));
  return left;
}

void expect_equal(const Contour& contour, const geometry::Remainder& expected, int number) {
  ASSERT_EQ(contour.whole(), expected.exposed_whole) << number;
  ASSERT_EQ(contour.arcs().size(), expected.exposed_count) << number;
  for (std::size_t a = 0; a < expected.exposed_count; ++a) {
    EXPECT_EQ(contour.arcs()[a].begin, expected.exposed_arcs[a].begin);
    EXPECT_EQ(contour.arcs()[a].end, expected.exposed_arcs[a].end);
    EXPECT_EQ(contour.arcs()[a].begin_by, expected.exposed_arcs[a].begin_by);
    EXPECT_EQ(contour.arcs()[a].end_by, expected.exposed_arcs[a].end_by);
  }
}

TEST(Contour, AllBallsAtOnceLeaveWhatOneAfterTheOtherDoes) {
  Random random(1);
  Contour contour, at_once;
  int whole = 0, partly = 0, covered = 0, of_several_arcs = 0;
  for (int n = 0; n < 3000; ++n) {
    const Blockers blockers = surroundings(random, n % 3 == 0 ? 70 : 12);
    const std::size_t circle = static_cast<std::size_t>(random.between(0, static_cast<double>(blockers.size())));
    const geometry::Remainder expected = one_after_the_other(blockers, circle);
    ASSERT_FALSE(expected.exposed_doubtful);
    contour.expose(blockers[circle].center, blockers[circle].weight, blockers, circle);
    expect_equal(contour, expected, n);
    ASSERT_TRUE(at_once.expose_at_once(blockers[circle].center, blockers[circle].weight, blockers, circle));
    expect_equal(at_once, expected, n);
    of_several_arcs += expected.exposed_count > 1;
    ++(contour.whole() ? whole : contour.arcs().empty() ? covered : partly);
  }
  EXPECT_GT(whole, 50);
  EXPECT_GT(partly, 500);
  EXPECT_GT(covered, 500);
  EXPECT_GT(of_several_arcs, 100);
}

// Two balls cover arcs that end together at one of their ends, but for `gap` radian, and overlap at the other.
TEST(Contour, EndsOfArcsThatRoundingMayExchangeAreNotDecidedAtOnce) {
  Contour contour;
  const double radius = std::sqrt(6.75);
  for (const double gap : {-1e-3, 0.0, 1e-3})
    for (int turn = 0; turn < 24; ++turn) {
      Blockers blockers;
      blockers.restart(9);
      blockers.add({0, 0, 3}, 9, 0);
      const auto cover = [&](double middle, double half_width) {
        const double angle = middle + 2 * kPi * turn / 24;
        const double weight = radius * radius + 4 - 4 * radius * std::cos(half_width);
        blockers.add({2 * std::cos(angle), 2 * std::sin(angle), 1.5}, weight,
                     static_cast<std::uint32_t>(blockers.size()));
      };
      cover(0, kPi * 100 / 180);
      cover(kPi * 190 / 180 + gap, kPi * 90 / 180);
      EXPECT_EQ(contour.expose_at_once(blockers[0].center, blockers[0].weight, blockers, 0), gap != 0) << turn;
      if (gap != 0) {
        EXPECT_EQ(contour.arcs().size(), gap < 0 ? 0u : 1u) << turn;
      }
    }
}

TEST(Contour, OneMoreBallLeavesWhatAllOfThemDo) {
  Random random(2);
  Contour step_by_step, at_once;
  for (int n = 0; n < 500; ++n) {
    const Blockers all = surroundings(random, 12);
    Blockers some;
    some.restart(all.first_weight());
    some.add(all[0].center, all[0].weight, all.label(0));
    step_by_step.expose(all[0].center, all[0].weight, some, 0);
    for (std::size_t k = 1; k < all.size(); ++k) {
      some.add(all[k].center, all[k].weight, all.label(k));
      step_by_step.expose_further(all[0].center, all[0].weight, some, 0);
      at_once.expose(all[0].center, all[0].weight, some, 0);
      ASSERT_EQ(step_by_step.whole(), at_once.whole());
      ASSERT_EQ(step_by_step.arcs().size(), at_once.arcs().size());
      for (std::size_t a = 0; a < at_once.arcs().size(); ++a)
        EXPECT_EQ(step_by_step.arcs()[a].begin, at_once.arcs()[a].begin);
    }
  }
}

TEST(Contour, ACircleWhoseSpheresBarelyMeetIsDecidedInQuadruplePrecision) {
  Blockers blockers;
  blockers.restart(9);
  blockers.add({0, 0, 6 - 1e-15}, 9, 1);
  Contour contour;
  EXPECT_FALSE(contour.expose_surely(blockers[0].center, blockers[0].weight, blockers, 0));
  contour.expose(blockers[0].center, blockers[0].weight, blockers, 0);
  EXPECT_EQ(contour.doubtful_count(), 1u);
}

/// Returns whether a ball other than those of the circle holds a point.
bool held_by_another(const Blockers& blockers, std::size_t circle, const glm::dvec3& x) {
  for (std::size_t b = 0; b < blockers.size(); ++b)
    if (b != circle && glm::dot(x - blockers[b].center, x - blockers[b].center) < blockers[b].weight) return true;
  return false;
}

void expect_covered(const Blockers& blockers, std::size_t n) {
  const geometry::Circle c =
      geometry::circle_of_two_spheres(blockers[n].center, blockers.first_weight(), blockers[n].weight);
  for (int s = 0; s < 60; ++s) {
    const double t = 2 * kPi * s / 60;
    const glm::dvec3 x = c.height * c.axis + c.radius * (std::cos(t) * c.u + std::sin(t) * c.v);
    EXPECT_TRUE(held_by_another(blockers, n, x)) << n << ' ' << s;
  }
}

TEST(SphereCover, CirclesThatAreRuledOutAreCovered) {
  Random random(3);
  SphereCover cover;
  int spheres = 0, ruled_out = 0, kept = 0;
  for (int n = 0; n < 300; ++n) {
    const Blockers blockers = surroundings(random, 70);
    const bool exposed = cover.test(blockers);
    if (!exposed) ++spheres;
    for (std::size_t circle = 0; circle < blockers.size(); ++circle) {
      const bool may_be = exposed && cover.circle_may_be_exposed(circle);
      ++(may_be ? kept : ruled_out);
      if (!may_be) expect_covered(blockers, circle);
    }
  }
  EXPECT_GT(spheres, 30);
  EXPECT_GT(ruled_out, 3000);
  EXPECT_GT(kept, 500);
}

// Returns the balls that touch the arc behind its ends, by their labels.
std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_of(const Contour& contour, const Blockers& blockers,
                                                             std::span<const std::uint8_t> uncovered) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const ExposedArc& arc : contour.arcs()) {
    const double middle = std::fmod(arc.begin + 0.5 * geometry::pseudo_sweep(arc.begin, arc.end), 4.0);
    if (uncovered.empty() ||
        SphereCover::is_near(contour.point(middle) / std::sqrt(blockers.first_weight()), uncovered))
      ends.emplace_back(arc.begin_by, arc.end_by);
  }
  std::ranges::sort(ends);
  return ends;
}

// No other ball changes the arcs.
TEST(SphereCover, BallsWithOpenCirclesLeaveTheArcsThatAllLeaveNearUncoveredDirections) {
  Random random(4);
  SphereCover cover;
  Contour of_open, of_all;
  std::size_t arcs = 0, left_out = 0, refused = 0;
  for (int n = 0; n < 1000; ++n) {
    const Blockers all = surroundings(random, 40);
    if (!cover.test(all)) continue;
    Blockers open;
    open.restart(all.first_weight());
    std::vector<std::size_t> in_all;
    for (std::size_t b = 0; b < all.size(); ++b) {
      if (!cover.circle_may_be_exposed(b)) continue;
      open.add(all[b].center, all[b].weight, all.label(b));
      in_all.push_back(b);
    }
    left_out += all.size() - open.size();
    for (std::size_t b = 0; b < open.size(); ++b) {
      if (!of_open.expose_at_once(open[b].center, open[b].weight, open, b)) continue;
      of_all.expose(open[b].center, open[b].weight, all, in_all[b]);
      const auto expected = ends_of(of_all, all, {});
      ASSERT_EQ(ends_of(of_open, open, cover.uncovered()), expected) << n << ' ' << b;
      arcs += expected.size();
      refused += of_open.arcs().size() - expected.size();
      ASSERT_EQ(of_all.whole(), of_open.whole() && SphereCover::is_near(of_open.point(0) / 3.0, cover.uncovered()));
    }
  }
  EXPECT_GT(arcs, 2000u);
  EXPECT_GT(left_out, 1000u);
  EXPECT_GT(refused, 20u);
}

/// Adds a ball whose cap of a sphere of radius 3 has this axis and this angle.
void add_cap(const glm::dvec3& axis, double angle, Blockers& blockers) {
  blockers.add(4.0 * axis, 9 + 16 - 24 * std::cos(angle), static_cast<std::uint32_t>(blockers.size()));
}

TEST(SphereCover, SmallHolesAreSeenUntilASmallCapCoversThem) {
  for (std::size_t n = 0; n < 2000; ++n) {
    const glm::dvec3 hole = spiral_direction(n, 2000);
    const double angle = 0.005 + 1e-5 * static_cast<double>(n);
    Blockers blockers;
    blockers.restart(9);
    add_cap(-hole, kPi - angle, blockers);
    EXPECT_TRUE(SphereCover().test(blockers)) << n;
    add_cap(hole, 0.9 * angle, blockers);
    EXPECT_TRUE(SphereCover().test(blockers)) << n;
    add_cap(hole, angle + 0.04, blockers);
    EXPECT_FALSE(SphereCover().test(blockers)) << n;
  }
}

TEST(SphereCover, ASphereWithoutNeighborsIsNotCovered) {
  Blockers blockers;
  blockers.restart(9);
  EXPECT_TRUE(SphereCover().test(blockers));
}

}  // namespace
}  // namespace meniscus
