// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's geometry on the GPU in single precision agrees with the same text in C++ in double.
#include <cmath>
#include <random>

#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/render/ray_geometry.h"
#include "tests/support/random_rays.h"

namespace meniscus {
namespace {

struct Query {
  glm::vec4 origin_major, direction_minor;
};
struct Answer {
  glm::vec4 torus_t, normal_at_first, sphere;
};

TEST(RayGeometryOnGpu, FindsTheRootsOfTheDoubleVersion) {
  EglContext context;
  const Program program("gpu_shaders/test_support/ray_geometry.comp");
  constexpr std::size_t kCount = 20000;
  std::mt19937 random(5);
  std::vector<testing::TorusQuery> queries(kCount);
  std::vector<Query> input;
  for (auto& q : queries) {
    q = testing::random_torus_query(random);
    input.push_back({glm::vec4(glm::vec3(q.origin), static_cast<float>(q.major)),
                     glm::vec4(glm::vec3(q.direction), static_cast<float>(q.minor))});
  }
  Buffer in{std::span<const Query>(input)}, out(kCount * sizeof(Answer));
  in.bind(0);
  out.bind(1);
  program.set(kernel::QueryParameters{.count = static_cast<std::uint32_t>(kCount)});
  program.dispatch((kCount + 63) / 64);
  const auto answers = out.download<Answer>(kCount);
  int compared = 0, grazing = 0;
  for (std::size_t n = 0; n < kCount; ++n) {
    const testing::TorusQuery& q = queries[n];
    const auto exact = geometry::ray_torus(q.origin, q.direction, q.major, q.minor, -20, 20, 1e-14);
    const int count = static_cast<int>(answers[n].normal_at_first.w);
    if (count != exact.count) {
      ++grazing;  // Rounding merges two roots that are near each other.
      continue;
    }
    for (int i = 0; i < count; ++i) {
      // A root moves by the error of the distance over the slope of the distance.
      const auto f = geometry::torus_factors(q.origin, q.direction, q.major, (q.major - q.minor) * (q.major + q.minor),
                                             exact.t[i], 1.0);
      const double slope = std::abs(f.apple_slope) / (2.0 * q.minor);
      EXPECT_LT(std::abs(answers[n].torus_t[i] - exact.t[i]) * std::min(slope, 1.0), 2e-5 / std::min(q.minor, 1.0))
          << n;
      ++compared;
    }
    const auto sphere = geometry::ray_sphere(q.origin, q.direction, q.minor);
    if (sphere.found && sphere.far_t - sphere.near_t > 0.01) {
      EXPECT_EQ(answers[n].sphere.z, 1.0f);
      EXPECT_NEAR(answers[n].sphere.x, sphere.near_t, 1e-4);
      EXPECT_NEAR(answers[n].sphere.y, sphere.far_t, 1e-4);
    }
  }
  EXPECT_GT(compared, 20000);  // Enough roots were compared.
  EXPECT_LT(grazing, 20);
}

}  // namespace
}  // namespace meniscus
