// SPDX-License-Identifier: BSD-3-Clause
// Casts rays from points on balls in directions all around, and counts those that meet no other ball.
#include "core/camera/open_side.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/spiral.h"

namespace meniscus {
namespace {

/// Å: so much wider than its balls the surface is, which closes the gaps between them. Of 0 to 1.4 this showed most of
/// the ligands of six complexes.
constexpr double kClosed = 0.4;
constexpr std::size_t kTriedSides = 500, kPoints = 500, kPointsOfBall = 12;

std::tuple<double, double, double, double> key_of(const Ball& ball) {
  return {ball.center.x, ball.center.y, ball.center.z, ball.radius};
}

std::vector<Ball> without(std::span<const Ball> all, std::span<const Ball> seen) {
  std::set<std::tuple<double, double, double, double>> keys;
  for (const Ball& ball : seen) keys.insert(key_of(ball));
  std::vector<Ball> others;
  std::ranges::copy_if(all, std::back_inserter(others), [&](const Ball& ball) { return !keys.contains(key_of(ball)); });
  return others;
}

/// Points on the balls that lie in none of them; of many balls a few are taken, evenly.
std::vector<glm::dvec3> points_on(std::span<const Ball> balls) {
  const std::size_t step = std::max<std::size_t>(1, balls.size() * kPointsOfBall / kPoints);
  std::vector<glm::dvec3> points;
  for (std::size_t b = 0; b < balls.size(); b += step) {
    for (std::size_t n = 0; n < kPointsOfBall; ++n) {
      const glm::dvec3 point = balls[b].center + balls[b].radius * spiral_direction(n, kPointsOfBall);
      const auto holds = [&](const Ball& ball) {
        return &ball != &balls[b] && glm::distance(point, ball.center) < ball.radius;
      };
      if (std::ranges::none_of(balls, holds)) points.push_back(point);
    }
  }
  return points;
}

/// What is seen along one direction.
struct Openness {
  std::size_t free = 0;  ///< points
  double cover = 0.0;    ///< Å, from each other point to where the ray leaves the last ball, summed
};

Openness openness(const glm::dvec3& toward, std::span<const glm::dvec3> points, std::span<const Ball> others,
                  const Ball& around) {
  // Only what is before the points can hide them.
  std::vector<Ball> near;
  for (const Ball& ball : others) {
    const glm::dvec3 from = ball.center - around.center;
    const double along = glm::dot(from, toward), reach = around.radius + ball.radius;
    if (along > -reach && glm::dot(from, from) - along * along < reach * reach) near.push_back(ball);
  }
  Openness open;
  for (const glm::dvec3& point : points) {
    double exit = 0.0;
    for (const Ball& ball : near) {
      const glm::dvec3 from = ball.center - point;
      const double along = glm::dot(from, toward);
      const double half = ball.radius * ball.radius - (glm::dot(from, from) - along * along);
      if (half > 0.0) exit = std::max(exit, along + std::sqrt(half));
    }
    if (exit > 0.0)
      open.cover += exit;
    else
      ++open.free;
  }
  return open;
}

/// The direction across the view along which the balls extend farthest.
glm::dvec3 longest_across(const glm::dvec3& toward, std::span<const Ball> balls) {
  const glm::dvec3 some = std::abs(toward.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(some, toward)), v = glm::cross(toward, u);
  glm::dvec3 middle(0.0);
  for (const Ball& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  double uu = 0.0, uv = 0.0, vv = 0.0;
  for (const Ball& ball : balls) {
    const double x = glm::dot(ball.center - middle, u), y = glm::dot(ball.center - middle, v);
    uu += x * x;
    uv += x * y;
    vv += y * y;
  }
  const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv);
  return std::cos(angle) * u + std::sin(angle) * v;
}

}  // namespace

ViewBasis open_side(std::span<const Ball> seen, std::span<const Ball> all) {
  std::vector<Ball> others = without(all, seen);
  for (Ball& ball : others) ball.radius += kClosed;
  const std::vector<glm::dvec3> points = points_on(seen);
  Ball around{glm::dvec3(0.0), 0.0};
  for (const Ball& ball : seen) around.center += ball.center / static_cast<double>(seen.size());
  for (const Ball& ball : seen)
    around.radius = std::max(around.radius, glm::distance(ball.center, around.center) + ball.radius);
  glm::dvec3 best = spiral_direction(0, kTriedSides);
  Openness most = openness(best, points, others, around);
  for (std::size_t n = 1; n < kTriedSides; ++n) {
    const glm::dvec3 toward = spiral_direction(n, kTriedSides);
    const Openness open = openness(toward, points, others, around);
    if (open.free < most.free || (open.free == most.free && open.cover >= most.cover)) continue;
    best = toward;
    most = open;
  }
  const glm::dvec3 right = longest_across(best, seen);
  return {right, glm::cross(best, right), -best};
}

}  // namespace meniscus
