// SPDX-License-Identifier: BSD-3-Clause
// The last resort for rims that meet themselves: a fan whose triangles run as the outline does, with the face on its
// left.
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/mesh/face_mesh.h"

namespace meniscus::testing {
namespace {

/// Returns the cap of a sphere around `axis`, its rim walked with the cap on the left as seen from the solvent.
FaceOutline cap_outline(const glm::dvec3& center, double radius, const glm::dvec3& axis, bool inwards) {
  const glm::dvec3 x = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, -0.8))), y = glm::cross(axis, x);
  FaceOutline outline;
  const int count = 12;
  const double opening = 0.7;
  for (int n = 0; n < count; ++n) {
    const double turn = (inwards ? -1 : 1) * 2 * std::numbers::pi * n / count;
    const glm::dvec3 u = std::cos(opening) * axis + std::sin(opening) * (std::cos(turn) * x + std::sin(turn) * y);
    outline.points.push_back({center + radius * u, {}});
    outline.names.push_back({0, static_cast<std::uint32_t>(n)});
    outline.edges.push_back({n, (n + 1) % count});
    outline.segments.push_back({0, static_cast<std::uint32_t>(n)});
  }
  outline.loop_count = 1;
  outline.domain = std::make_unique<SphereDomain>(center, radius, std::span<const Plane>{}, -axis, inwards);
  return outline;
}

TEST(FanOutline, TurnsAsTheOutlineDoesAndClosesTheFace) {
  const glm::dvec3 center(3, -2, 5), axis = glm::normalize(glm::dvec3(1, 2, -0.5));
  for (const bool inwards : {false, true}) {
    SCOPED_TRACE(inwards ? "concave" : "convex");
    const FaceOutline outline = cap_outline(center, 1.4, axis, inwards);
    const auto rim = outline.edges;
    const FaceMesh mesh = fan_outline(cap_outline(center, 1.4, axis, inwards));
    ASSERT_EQ(mesh.triangles.size(), rim.size());
    ASSERT_EQ(mesh.points.size(), rim.size() + 1);
    EXPECT_NEAR(glm::distance(mesh.points.back().position, center), 1.4, 1e-12) << "the middle is on the sphere";
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : mesh.triangles) {
      const glm::dvec3 a = mesh.points[t[0]].position, b = mesh.points[t[1]].position, c = mesh.points[t[2]].position;
      const glm::dvec3 towards_solvent = (inwards ? -1.0 : 1.0) * ((a + b + c) / 3.0 - center);
      EXPECT_GT(glm::dot(glm::cross(b - a, c - a), towards_solvent), 0.0);
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second) << "each edge is walked once in this direction";
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> open;  // edges without their reverse: the rim, as it was walked
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) open.insert({from, to});
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const auto& [from, to] : rim) expected.insert({std::uint32_t(from), std::uint32_t(to)});
    EXPECT_EQ(open, expected);
  }
}

}  // namespace
}  // namespace meniscus::testing
