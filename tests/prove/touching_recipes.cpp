// SPDX-License-Identifier: BSD-3-Clause
// Chains, near misses, nested balls and Soddy's spheres: decisions where two spheres barely meet.
#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "tests/prove/recipes.h"

namespace meniscus::testing {
namespace {

double radius_or(Dice& dice, double equal) { return equal > 0 ? equal : dice.radius(); }

/// Brings `part` along a direction from afar, until the first of its SAS balls is `gap` from one of `balls`.
void join(Balls& balls, const Balls& part, double probe_radius, const glm::dvec3& direction, double gap) {
  double way = 0;
  for (const Ball& a : balls)
    for (const Ball& b : part) {
      const glm::dvec3 between = b.center - a.center;
      const double along = glm::dot(between, direction), reach = a.radius + b.radius + 2 * probe_radius + gap;
      const double room = along * along - glm::dot(between, between) + reach * reach;
      if (room >= 0) way = std::max(way, std::sqrt(room) - along);
    }
  for (const Ball& b : part) balls.push_back({b.center + way * direction, b.radius});
}

// SAS balls miss or meet each other by 1e-10 to 1e-7 Å, and each such pair is the only link between its parts.
Made near_miss(Dice& dice) {
  const double p = dice.chance(0.1) ? 0.0 : dice.probe();
  const double equal = dice.chance(0.5) ? dice.radius() : 0.0;
  const auto single = [&] { return Balls{{{0, 0, 0}, radius_or(dice, equal)}}; };
  const auto cluster = [&] {
    const int count = dice.count(2, 12);
    const double box = dice.between(2, 6);
    return gas(dice.bits()(), count, box, 1.0, 2.0);
  };
  const auto gap = [&] { return dice.hair(-10, -7); };
  // Draws follow one another, for compilers evaluate arguments in an order of their own.
  const auto add = [&](Balls& balls, const Balls& part) {
    const glm::dvec3 direction = dice.direction();
    join(balls, part, p, direction, gap());
  };
  Balls balls;
  switch (dice.count(0, 4)) {
    case 0:  // two parts
      balls = single();
      add(balls, single());
      break;
    case 1:  // beads on a string, bent or straight
    {
      const glm::dvec3 straight = dice.direction();
      const double bend = dice.chance(0.3) ? 0.0 : dice.between(0, 1);
      balls = single();
      for (int n = 0, count = dice.count(2, 10); n < count; ++n) {
        const glm::dvec3 direction = glm::normalize(straight + bend * dice.direction());
        const double r = radius_or(dice, equal), reach = balls.back().radius + r + 2 * p + gap();
        balls.push_back({balls.back().center + reach * direction, r});
      }
      break;
    }
    case 2:  // a bonded pair with beads around it
      balls = single();
      balls.push_back({{dice.between(0.8, 2.5), 0, 0}, radius_or(dice, equal)});
      for (int n = 0, count = dice.count(1, 4); n < count; ++n) add(balls, single());
      break;
    case 3:  // beads around one
    {
      const std::array<glm::dvec3, 6> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
      balls = single();
      for (int n = 0, count = dice.count(2, 6); n < count; ++n) {
        const double r = radius_or(dice, equal), reach = balls.front().radius + r + 2 * p + gap();
        balls.push_back({reach * axes[static_cast<std::size_t>(n)], r});
      }
      break;
    }
    default:  // two clusters, or a cluster and one
      balls = cluster();
      add(balls, dice.chance(0.5) ? cluster() : single());
  }
  return {balls, p};
}

// Each touches the next, as vdW or as SAS spheres, exactly or but for a hair, in a straight, bent or closed chain.
Made tangent_chain(Dice& dice) {
  const double p = dice.probe(), grows = dice.chance(0.3) ? dice.between(0.7, 1.4) : 1.0;
  const double equal = dice.chance(0.6) ? dice.radius() : 0.0;
  const double extra = dice.chance(0.7) ? 2 * p : 0.0, hair = dice.chance(0.5) ? 0.0 : dice.hair(-14, -9);
  const int count = dice.count(2, 14);
  if (dice.chance(0.2))
    return {ring(std::max(3, count), 2 * (equal > 0 ? equal : 1.5) + extra + hair, equal > 0 ? equal : 1.5), p};
  const double bend = dice.chance(0.4) ? 0.0 : dice.between(0, kPi / 2);
  Balls balls = {{{0, 0, 0}, radius_or(dice, equal)}};
  for (int n = 1; n < count; ++n) {
    const double r = std::clamp(radius_or(dice, equal) * std::pow(grows, n), 0.3, 12.0);
    const double turn = n % 2 ? bend : -bend, reach = balls.back().radius + r + extra + hair;
    balls.push_back({balls.back().center + reach * glm::dvec3(std::cos(turn), std::sin(turn), 0), r});
  }
  return {balls, p};
}

// Balls lie in balls, each nearly touching the one around it from inside.
Made dolls(Dice& dice) {
  const double p = dice.small_probe();
  Balls balls = {{{0, 0, 0}, dice.between(2, 8)}};
  const bool along_axes = dice.chance(0.4);
  for (int n = 0, count = dice.count(1, 9); n < count; ++n) {
    const Ball around = balls[static_cast<std::size_t>(dice.chance(0.6) ? n : dice.count(0, n))];
    const double r = around.radius * dice.between(0.3, 0.98);
    const double hair = dice.chance(0.3) ? 0.0 : dice.hair(-14, -4);
    const glm::dvec3 direction = along_axes ? glm::dvec3(n % 3 == 0, n % 3 == 1, n % 3 == 2) : dice.direction();
    balls.push_back({around.center + (around.radius - r + hair) * direction, r});
  }
  return {balls, p};
}

// Five of Soddy's spheres touch each other, and then again and again the other one that touches four of them.
// Curvatures of the two, and curvatures times centres, add up to the sum of those of the four.
Made soddy(Dice& dice) {
  struct Bent {
    double curvature;
    glm::dvec3 moment;
  };
  using Five = std::array<Bent, 5>;
  const Balls corners = tetrahedron(2.0, 1.0);
  Five first{};
  for (std::size_t n = 0; n < 4; ++n) first[n] = {1.0, corners[n].center};
  first[4] = {2 + std::sqrt(6.0), {0, 0, 0}};
  std::vector<Bent> all(first.begin(), first.end());
  std::vector<Five> open = {first};
  const std::size_t most = static_cast<std::size_t>(dice.count(5, 24));
  for (std::size_t f = 0; f < open.size() && all.size() < most; ++f)
    for (std::size_t n = 0; n < 5 && all.size() < most; ++n) {
      Five next = open[f];
      Bent sum{-next[n].curvature, -next[n].moment};
      for (std::size_t k = 0; k < 5; ++k)
        if (k != n) sum = {sum.curvature + next[k].curvature, sum.moment + next[k].moment};
      // The other sphere of the first five but the inner one lies around all of them.
      if (sum.curvature <= 0.01 || std::ranges::any_of(all, [&](const Bent& b) {
            return std::abs(b.curvature - sum.curvature) < 1e-9 && glm::distance(b.moment, sum.moment) < 1e-6;
          }))
        continue;
      next[n] = sum;
      all.push_back(sum);
      open.push_back(next);
    }
  double sharpest = 0;
  for (const Bent& b : all) sharpest = std::max(sharpest, b.curvature);
  const bool by_probe = dice.chance(0.6);
  const double p = by_probe ? dice.small_probe() : dice.probe();
  const double scale = by_probe ? (p + dice.between(0.2, 1.5)) * sharpest : dice.between(1, 4);
  Balls balls;
  for (const Bent& b : all) {
    if (dice.chance(0.15)) continue;
    balls.push_back({b.moment * (scale / b.curvature), scale / b.curvature - (by_probe ? p : 0.0)});
  }
  if (balls.empty()) balls.push_back({{0, 0, 0}, 1.5});
  return {balls, p};
}

}  // namespace

std::vector<Recipe> touching_recipes() {
  return {{"near-miss", near_miss}, {"tangent-chain", tangent_chain}, {"dolls", dolls}, {"soddy", soddy}};
}

}  // namespace meniscus::testing
