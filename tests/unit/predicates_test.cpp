// SPDX-License-Identifier: BSD-3-Clause
// The predicates of circle.glsl against sampling, and fixed probes against the distances they must have.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/math/geometry.h"

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

/// Whether a pseudo-angle lies on the arc that runs counter-clockwise from begin to end.
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
  bool on_its_side;  ///< of the plane of the atoms
};

/// A probe over three atoms that stand `off_line` Å from being in line.
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
  const glm::dvec3 p = fixed_probe(b, c, ra, rb, rc, side, 1.5e-9, 1e-7).position;
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

TEST(ContactHeight, IsWhereTheRollingProbeTouches) {
  const double r = 1.7, p = 1.4, other = 1.2, distance = 3.1;
  const Circle circle = circle_of_two_spheres({distance, 0, 0}, (r + p) * (r + p), (other + p) * (other + p));
  const glm::dvec3 probe = circle.height * circle.axis + circle.radius * circle.u;
  const glm::dvec3 contact = probe * (r / (r + p));
  EXPECT_NEAR(contact_height(distance, r, r + p, other + p), contact.x, 1e-14);
}

}  // namespace
}  // namespace meniscus::geometry
