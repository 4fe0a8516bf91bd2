// SPDX-License-Identifier: BSD-3-Clause
// Compares caps by the angles between their axes, the widest first.
#include "core/reduced_surface/contour/nested_caps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

constexpr std::size_t kMostCompared = 64;
/// Å: the allowed difference of radii from the radii of the weights: more than weights grow or shrink by, and than
/// rounding.
constexpr double kRadiusBlur = 1e-8;
/// Borders of smaller caps, and of those that leave less, are dominated by rounding.
constexpr double kLeastSine = 1e-3;

}  // namespace

const std::vector<std::uint8_t>& NestedCaps::find(const Blockers& blockers) {
  const double radius = std::sqrt(blockers.first_weight());
  caps_.clear();
  widest_.clear();
  nested_.assign(blockers.size(), 0);
  for (std::uint32_t n = 0; n < blockers.size(); ++n) {
    const Blockers::Ball ball = blockers[n];
    const double cosine = ball.half_power / (ball.distance * radius), sine = std::sqrt(1.0 - cosine * cosine);
    if (!(sine > kLeastSine)) continue;
    const double moved = kRadiusBlur * (radius + std::sqrt(ball.weight)) / ball.distance + kRadiusBlur;
    caps_.push_back({n, ball.center / ball.distance, cosine, sine, moved / (radius * sine)});
  }
  std::ranges::sort(caps_, {}, &Cap::cosine);
  for (const Cap& cap : caps_) {
    const bool is_nested = std::ranges::any_of(widest_, [&](const Cap& wide) {
      const double blur = cap.blur + wide.blur;
      const double sine = wide.sine * cap.cosine - wide.cosine * cap.sine;  // sine of the difference of their angles
      const double cosine = wide.cosine * cap.cosine + wide.sine * cap.sine;
      return sine > blur && glm::dot(wide.axis, cap.axis) > cosine + blur * (sine + blur);
    });
    nested_[cap.ball] = is_nested;
    if (!is_nested && widest_.size() < kMostCompared) widest_.push_back(cap);
  }
  return nested_;
}

}  // namespace meniscus
