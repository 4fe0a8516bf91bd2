// SPDX-License-Identifier: BSD-3-Clause
// One grid over the balls of all copies; each ball looks for those of other copies within reach.
#include "core/queries/copy_contact.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/math/ball_grid.h"
#include "core/math/rigid_motion.h"

namespace meniscus {
namespace {

constexpr double kRounding = 1e-6;  // Å

/// The room between two balls, and who they are; the smallest is the closest, ties go to the lowest indices.
struct Pair {
  double gap = 0.0;
  std::uint32_t a = kNone, b = kNone;
  bool operator<(const Pair& other) const { return std::tie(gap, a, b) < std::tie(other.gap, other.a, other.b); }
};

struct PlacedBalls {
  std::vector<CopiedBall> who;
  std::vector<Ball> balls;
};

PlacedBalls place(std::span<const CopiedBalls> groups) {
  PlacedBalls placed;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    for (std::uint32_t c = 0; c < groups[g].motions.size(); ++c) {
      for (std::uint32_t b = 0; b < groups[g].balls.size(); ++b) {
        placed.who.push_back({g, c, b});
        placed.balls.push_back({groups[g].motions[c](groups[g].balls[b].center), groups[g].balls[b].radius});
      }
    }
  }
  return placed;
}

}  // namespace

std::optional<CopyContact> closest_contact(std::span<const CopiedBalls> groups, double probe_radius) {
  const PlacedBalls placed = place(groups);
  double largest = 0.0;
  for (const Ball& ball : placed.balls) largest = std::max(largest, ball.radius);
  const BallGrid grid(std::span<const Ball>(placed.balls), largest + probe_radius);
  // Atoms of one group move together: only those of the same motion belong to one copy.
  const auto same_copy = [&](std::uint32_t a, std::uint32_t b) {
    return placed.who[a].group == placed.who[b].group && placed.who[a].copy == placed.who[b].copy;
  };
  const auto search = [&](const tbb::blocked_range<std::uint32_t>& range, Pair closest) {
    for (std::uint32_t a = range.begin(); a != range.end(); ++a) {
      const Ball& ball = placed.balls[a];
      const double reach = ball.radius + largest + 2.0 * probe_radius + kRounding;
      grid.for_each_near(ball.center, reach, [&](std::uint32_t b) {
        if (b <= a || same_copy(a, b)) return;
        const double radii = ball.radius + placed.balls[b].radius;
        const Pair pair{glm::distance(ball.center, placed.balls[b].center) - radii, a, b};
        if (pair.gap <= 2.0 * probe_radius + kRounding && (closest.a == kNone || pair < closest)) closest = pair;
      });
    }
    return closest;
  };
  const auto nearer = [](const Pair& x, const Pair& y) {
    if (x.a == kNone || y.a == kNone) return x.a == kNone ? y : x;
    return std::min(x, y);
  };
  const Pair closest =
      tbb::parallel_reduce(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(placed.balls.size()), 1024),
                           Pair{}, search, nearer);
  if (closest.a == kNone) return std::nullopt;
  return CopyContact{{placed.who[closest.a], placed.who[closest.b]},
                     glm::distance(placed.balls[closest.a].center, placed.balls[closest.b].center)};
}

}  // namespace meniscus
