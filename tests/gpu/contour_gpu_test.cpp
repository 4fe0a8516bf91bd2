// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up on the GPU agrees with the same text in C++, so that double precision is double there.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/reduced_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

/// The struct of gpu_shaders/test_support/contour.comp.
struct Answer {
  glm::uvec4 counted;
  glm::dvec2 ends[8];
  glm::uvec2 labels[8];
};

/// The circles of a molecule, each with the neighbours of its first atom.
struct Circles {
  std::vector<glm::dvec4> atoms;
  std::vector<glm::uvec4> circles;
  std::vector<std::uint32_t> neighbors;
};

Circles circles_of(const std::vector<Ball>& balls, double probe_radius) {
  Circles result;
  const std::vector<double> weights = decision_weights(balls, probe_radius);
  for (std::size_t a = 0; a < balls.size(); ++a) result.atoms.emplace_back(balls[a].center, weights[a]);
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(result.neighbors.size());
    for (std::uint32_t k = 0; k < balls.size(); ++k)
      if (k != i && glm::distance(balls[i].center, balls[k].center) < std::sqrt(weights[i]) + std::sqrt(weights[k]) &&
          balls[i].center != balls[k].center)
        result.neighbors.push_back(k);
    const auto last = static_cast<std::uint32_t>(result.neighbors.size());
    for (std::uint32_t n = first; n < last; ++n)
      if (result.neighbors[n] > i) result.circles.emplace_back(i, result.neighbors[n], first, last);
  }
  return result;
}

geometry::Remainder on_host(const Circles& of, const glm::uvec4& circle) {
  const glm::dvec4 first = of.atoms[circle.x], second = of.atoms[circle.y];
  geometry::Remainder left;
  left.begin_contour(geometry::circle_of_two_spheres(glm::dvec3(second) - glm::dvec3(first), first.w, second.w),
                     first.w, geometry::kUnitRoundoff);
  for (std::uint32_t n = circle.z; n < circle.w && !left.contour_ended(); ++n) {
    const glm::dvec4 other = of.atoms[of.neighbors[n]];
    if (of.neighbors[n] != circle.y)
      left.block(geometry::blocking_ball(glm::dvec3(other) - glm::dvec3(first), other.w, first.w), of.neighbors[n]);
  }
  return left;
}

// Ties are decided by 1e-9 of a radius: an end that is rounded to single precision on its way decides otherwise, and is
// sure of it.
TEST(ContourOnGpu, DecidesTiesInDouble) {
  const EglContext context;
  const Program program("gpu_shaders/test_support/contour.comp");
  std::size_t decided = 0;
  for (const auto& [name, balls, probe_radius] : testing::degenerate_molecules()) {
    const Circles of = circles_of(balls, probe_radius);
    if (of.circles.empty()) continue;
    const Buffer atoms{std::span<const glm::dvec4>(of.atoms)}, circles{std::span<const glm::uvec4>(of.circles)},
        neighbors{std::span<const std::uint32_t>(of.neighbors)};
    Buffer out(of.circles.size() * sizeof(Answer));
    atoms.bind(0);
    circles.bind(1);
    neighbors.bind(2);
    out.bind(3);
    program.set(kernel::QueryParameters{.count = static_cast<std::uint32_t>(of.circles.size())});
    program.dispatch((of.circles.size() + 63) / 64);
    const auto answers = out.download<Answer>(of.circles.size());
    for (std::size_t n = 0; n < answers.size(); ++n) {
      const geometry::Remainder expected = on_host(of, of.circles[n]);
      const Answer& found = answers[n];
      // The last bits of a bound decide which of them are in doubt.
      if (expected.exposed_doubtful || found.counted.z != 0) continue;
      ++decided;
      ASSERT_EQ(found.counted.x, expected.exposed_count) << name << ", circle " << n;
      ASSERT_EQ(found.counted.y != 0, expected.exposed_whole) << name << ", circle " << n;
      const double bound = 2.0 * expected.exposed_error + 32.0 * geometry::kUnitRoundoff;
      for (std::uint32_t a = 0; a < expected.exposed_count; ++a) {
        const ExposedArc& arc = expected.get_arc(a);
        EXPECT_EQ(found.labels[a], glm::uvec2(arc.begin_by, arc.end_by)) << name << ", circle " << n;
        EXPECT_LT(std::abs(found.ends[a].x - arc.begin), bound) << name << ", circle " << n;
        EXPECT_LT(std::abs(found.ends[a].y - arc.end), bound) << name << ", circle " << n;
      }
    }
  }
  EXPECT_GT(decided, 2000u);
}

}  // namespace
}  // namespace meniscus
