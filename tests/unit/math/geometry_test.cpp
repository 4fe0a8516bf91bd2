// SPDX-License-Identifier: BSD-3-Clause
// The predicates of circle.glsl against sampling, and fixed probes against the distances they must have.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/math/double_geometry.h"

namespace meniscus::geometry {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 500;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double unit() { return uniform_(engine_); }
  double normal() { return normal_(engine_); }
  glm::dvec3 vector() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  std::normal_distribution<double> normal_;
};

/// Returns whether a pseudo-angle lies on the arc that runs counter-clockwise from begin to end.
bool on_arc(double begin, double end, double pseudo) { return pseudo_sweep(begin, pseudo) < pseudo_sweep(begin, end); }

TEST(PseudoAngle, RisesWithTheAngleAndNamesItsDirection) {
  double before = -1;
  for (int n = 0; n < 4000; ++n) {
    const double angle = 2 * kPi * n / 4000;
    const glm::dvec2 u(std::cos(angle), std::sin(angle));
    const double pseudo = pseudo_angle(u * 0.37);
    if (n > 0) {
      EXPECT_GT(pseudo, before) << n;
    }
    EXPECT_LT(pseudo, 4.0);
    EXPECT_NEAR(glm::distance(direction_at(pseudo), u), 0, 1e-14);
    before = pseudo;
  }
}

TEST(CoveredArc, IsWhatTheBallCoversOfTheCircle) {
  Random random(1);
  int meetings[3] = {};
  for (int n = 0; n < 2000; ++n) {
    const double r0 = 1 + 2 * random.unit(), r1 = 1 + 2 * random.unit(), rq = 1 + 2 * random.unit();
    const glm::dvec3 d = (std::abs(r0 - r1) + (r0 + r1 - std::abs(r0 - r1)) * (0.05 + 0.9 * random.unit())) *
                         glm::normalize(random.vector());
    const Circle circle = circle_of_two_spheres(d, r0 * r0, r1 * r1);
    ASSERT_GT(circle.radius, 0);
    const glm::dvec3 q = 1.5 * random.vector();
    const HalfPlane h = covered_half_plane(circle, r0 * r0, q, glm::length(q), rq * rq, kUnitRoundoff);
    double margin = 0;
    const int meeting = meet_circle(h, margin);
    ASSERT_GT(margin, 0);
    ++meetings[meeting];
    const CoveredArc arc = meeting == kCuts ? covered_arc(h) : CoveredArc{0, 0, 0};
    for (int k = 0; k < kSamples; ++k) {
      const double pseudo = 4.0 * k / kSamples;
      const glm::dvec2 e = direction_at(pseudo);
      const glm::dvec3 x = circle.height * circle.axis + circle.radius * (e.x * circle.u + e.y * circle.v);
      ASSERT_NEAR(glm::length(x), r0, 1e-12);
      ASSERT_NEAR(glm::distance(x, d), r1, 1e-12);
      if (std::abs(glm::distance(x, q) - rq) < 1e-9) continue;
      const bool covered = meeting == kCovers || (meeting == kCuts && on_arc(arc.begin, arc.end, pseudo));
      ASSERT_EQ(covered, glm::distance(x, q) < rq) << "case " << n << ", meeting " << meeting;
    }
  }
  for (const int count : meetings) EXPECT_GT(count, 100);
}

TEST(ClipArc, LeavesWhatIsNotCovered) {
  Random random(2);
  int changes[6] = {};
  for (int n = 0; n < 3000; ++n) {
    const double begin = 4 * random.unit(), end = 4 * random.unit();
    const CoveredArc covered{4 * random.unit(), 4 * random.unit(), 0};
    double margin = 0;
    const int change = clip_arc(begin, end, covered, margin);
    ++changes[change];
    std::vector<std::pair<double, double>> left;
    if (change == kKeep) left = {{begin, end}};
    if (change == kCutBegin) left = {{covered.end, end}};
    if (change == kCutEnd) left = {{begin, covered.begin}};
    if (change == kComplement) left = {{covered.end, covered.begin}};
    if (change == kSplit) left = {{begin, covered.begin}, {covered.end, end}};
    for (int k = 0; k < kSamples; ++k) {
      const double pseudo = 4 * (k + 0.5) / kSamples;
      const bool shown = on_arc(begin, end, pseudo) && !on_arc(covered.begin, covered.end, pseudo);
      const bool kept =
          std::any_of(left.begin(), left.end(), [&](const auto& arc) { return on_arc(arc.first, arc.second, pseudo); });
      ASSERT_EQ(kept, shown) << "case " << n << ", change " << change;
    }
    EXPECT_GE(margin, 0);
  }
  for (const int count : changes) EXPECT_GT(count, 100);
}

struct PlacedProbe {
  double worst_gap;  ///< Å between the probe and the atoms it should touch
  bool on_its_side;  ///< side of the atoms' plane
};

/// Places a probe over three atoms that are `off_line` Å from being in line.
PlacedProbe place(double off_line, Random& random) {
  const glm::dvec3 along = glm::normalize(random.vector());
  const glm::dvec3 aside = glm::normalize(glm::cross(along, random.vector()));
  const glm::dvec3 b = (1.5 + random.unit()) * along, c = -(1.5 + random.unit()) * along + off_line * aside;
  const glm::dvec3 normal = glm::normalize(glm::cross(b, c));
  glm::dvec3 x(0.0);  // touches all three, not in the plane of its atoms, where probes are placed otherwise
  while (std::abs(glm::dot(normal, x)) < 1e-2) {
    const glm::dvec3 v = random.vector(), across = glm::normalize(v - along * glm::dot(v, along));
    x = (2.0 + random.unit()) * across + (random.unit() - 0.5) * along;
  }
  const double ra = glm::length(x), rb = glm::distance(x, b), rc = glm::distance(x, c);
  const double side = glm::dot(normal, x) > 0 ? 1.0 : -1.0;
  const glm::dvec3 p = fixed_probe(b, c, ra, rb, rc, side).position;
  const double gap =
      std::max({std::abs(glm::length(p) - ra), std::abs(glm::distance(p, b) - rb), std::abs(glm::distance(p, c) - rc)});
  return {gap, glm::dot(normal, p) * side > 0};
}

TEST(FixedProbe, TouchesItsAtomsOnItsSideHoweverSlimTheirTriangle) {
  Random random(3);
  for (const double off_line : {1.0, 1e-2, 1e-4})
    for (int n = 0; n < 300; ++n) {
      const PlacedProbe probe = place(off_line, random);
      EXPECT_LT(probe.worst_gap, 3e-15) << off_line;
      EXPECT_TRUE(probe.on_its_side);
    }
}

TEST(Constants, AreTheDecimalsThatTheyStandFor) {
  EXPECT_EQ(kLargestGrowth, 1.5e-9);
  EXPECT_EQ(kFlat, 1e-7);
  EXPECT_EQ(kMergeDistance, 1e-6);
  EXPECT_EQ(kSteep, 0.01);
  EXPECT_EQ(kTouchDistance, 1e-9);
  EXPECT_EQ(kTouchingCircle, 1e-12);
}

TEST(ProbesInOnePlace, AreNearAndNotMirroredInThePlaneOfTheirAtoms) {
  const glm::dvec3 apart(0, 0, 8e-7);
  EXPECT_TRUE(are_coincident(apart, 0.5, 0.02));
  EXPECT_FALSE(are_coincident(2.0 * apart, 0.5, 0.02));
  EXPECT_FALSE(are_coincident(apart, 4e-7, 4e-7)) << "one on either side of its atoms";
  EXPECT_FALSE(may_be_coincident(apart, 4e-7, 4e-7)) << "both flat";
  EXPECT_TRUE(may_be_coincident(500.0 * apart, 4e-7, 0.02));
  EXPECT_FALSE(may_be_coincident(1000.0 * apart, 4e-7, 0.02));
  EXPECT_TRUE(touches_atom({0, 0, 3}, 3 + 9e-7));
  EXPECT_FALSE(touches_atom({0, 0, 3}, 3 + 2e-6));
}

/// Returns the part of the circle of two balls that the ball of `third` covers, in pseudo-angles of the circle's frame.
CoveredArc arc_covered(const std::array<glm::dvec3, 3>& centers, const std::array<double, 3>& radii, int i, int j,
                       int k, Circle& circle) {
  circle = circle_of_two_spheres(centers[j] - centers[i], radii[i] * radii[i], radii[j] * radii[j]);
  return covered_by(circle, radii[i] * radii[i], centers[k] - centers[i], radii[k] * radii[k]);
}

TEST(Triple, IsNamedAlikeByThePointWhereverAnArcEndsThere) {
  Random random(5);
  for (int n = 0; n < 200; ++n) {
    // The three spheres meet in one point.
    const std::array<glm::dvec3, 3> centers{2.0 * random.vector(), 2.0 * random.vector(), 2.0 * random.vector()};
    const glm::dvec3 point = random.vector();
    std::array<double, 3> radii{};
    for (int a = 0; a < 3; ++a) radii[a] = glm::distance(point, centers[a]);
    const double over = glm::dot(glm::cross(centers[1] - centers[0], centers[2] - centers[0]), point - centers[0]);
    if (std::abs(over) < 0.1) continue;
    const int circles[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
    for (const auto& names : circles) {
      const int i = names[0], j = names[1], k = names[2];
      Circle circle;
      const CoveredArc covered = arc_covered(centers, radii, i, j, k, circle);
      const auto at = [&](double pseudo) {
        const glm::dvec2 e = direction_at(pseudo);
        return centers[i] + circle.axis * circle.height + circle.radius * (e.x * circle.u + e.y * circle.v);
      };
      const bool at_end = glm::distance(at(covered.begin), point) < glm::distance(at(covered.end), point);
      EXPECT_NEAR(glm::distance(at(at_end ? covered.begin : covered.end), point), 0, 1e-6);
      const Triple t = triple_at(10 + i, 10 + j, 10 + k, at_end);
      EXPECT_EQ(t.a, 10u);
      EXPECT_EQ(t.b, 11u);
      EXPECT_EQ(t.c, 12u);
      EXPECT_EQ(t.side, over > 0 ? 1u : 0u) << "circle " << i << ' ' << j;
      EXPECT_EQ(role_of_third(i, j, k), static_cast<uint>(2 - k));
    }
  }
}

TEST(VanishingArc, IsNoneThatLeavesOutWhatItsBallsCover) {
  const double here = 2.0, before_here = std::nextafter(here, 0.0);
  EXPECT_TRUE(arc_vanishes({1, here, 0}, {here + 1e-9, 3, 0}));
  EXPECT_TRUE(arc_vanishes({1, here, 0}, {before_here, 3, 0})) << "rounding made it less than nothing";
  EXPECT_TRUE(arc_vanishes({here - 1e-4, here, 0}, {before_here, here + 1e-4, 0}));
  EXPECT_FALSE(arc_vanishes({here - 1e-4, here, 0}, {here - 1e-4, here - 1e-5, 0})) << "nearly a whole turn";
}

TEST(RollingArc, RunsFromProbeToProbeAboutTheAxis) {
  Random random(6);
  const glm::dvec3 origin(1, 2, 3), d(0.8, -1.1, 1.6);
  const double r0 = 3.1, r1 = 2.9, p = 1.4;
  const RollingArc whole = whole_turn(origin, d, r0, r1, r0 * r0, r1 * r1, p);
  const glm::dvec3 side = glm::cross(whole.axis, whole.start);
  const auto probe = [&](double t) {
    return whole.center + whole.radius * (std::cos(t) * whole.start + std::sin(t) * side);
  };
  for (int n = 0; n < 100; ++n) {
    const double begin = 6 * random.unit(), sweep = 6 * random.unit();
    const RollingArc part = part_between(whole, probe(begin), probe(begin + sweep));
    EXPECT_NEAR(glm::distance(probe(begin), origin), r0, 1e-14);
    EXPECT_NEAR(glm::distance(probe(begin), origin + d), r1, 1e-14);
    EXPECT_NEAR(glm::distance(part.center + part.radius * part.start, probe(begin)), 0, 1e-14);
    EXPECT_NEAR(part.cosine, std::cos(sweep), 1e-13);
    EXPECT_NEAR(part.sine, std::sin(sweep), 1e-13);
  }
  const double as_large = whole.radius + 5e-10;
  EXPECT_EQ(whole_turn(origin, d, r0, r1, r0 * r0, r1 * r1, as_large).radius, as_large);
}

TEST(PolygonReach, IsTheWholeRadiusInsideAndLessBeside) {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto reach_towards = [&](const glm::dvec3& d) {
    PolygonReach reach = no_reach();
    add_side(reach, x, z, d);  // counter-clockwise seen from the probe
    add_side(reach, z, y, d);
    add_side(reach, y, x, d);
    return cut_reach(reach, 1.4);
  };
  EXPECT_NEAR(reach_towards(glm::normalize(x + y + z)), 2.8, 1e-14);
  EXPECT_NEAR(reach_towards(glm::normalize(x + y - z)), 2.8 * std::sqrt(2.0 / 3.0), 1e-14) << "the side from x to y";
  EXPECT_NEAR(reach_towards(glm::normalize(3.0 * x - y - z)), 2.8 * 3 / std::sqrt(11.0), 1e-14) << "the corner x";
}

TEST(ContactHeight, IsWhereTheRollingProbeTouches) {
  const double r = 1.7, p = 1.4, other = 1.2, distance = 3.1;
  const Circle circle = circle_of_two_spheres({distance, 0, 0}, (r + p) * (r + p), (other + p) * (other + p));
  const glm::dvec3 probe = circle.height * circle.axis + circle.radius * circle.u;
  const glm::dvec3 contact = probe * (r / (r + p));
  EXPECT_NEAR(contact_height(distance, r, r + p, other + p), contact.x, 1e-14);
}

}  // namespace
}  // namespace meniscus::geometry
