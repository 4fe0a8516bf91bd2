// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of circle.glsl for many balls at once: loops over columns of numbers, which compilers make vectors of.
#include "core/reduced_surface/contour/blockers.h"

#include <algorithm>
#include <vector>

#include "core/math/vector_clones.h"

namespace meniscus {

namespace {

MENISCUS_VECTOR_CLONES
void measure_all(const Blockers::Columns& balls, std::size_t count, double first_weight, double* square,
                 double* distance, double* half_power) {
  const Blockers::Columns b = balls;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const geometry::Blocker ball =
        geometry::blocking_ball(glm::dvec3(b.x[n], b.y[n], b.z[n]), b.weight[n], first_weight);
    square[n] = ball.square;
    distance[n] = ball.distance;
    half_power[n] = ball.half_power;
  }
}

}  // namespace

void Blockers::restart(double first_weight) {
  first_weight_ = first_weight;
  labels_.clear();
}

void Blockers::add(const glm::dvec3& center, double weight, std::uint32_t label) {
  const std::size_t n = labels_.size();
  table_.make_room(n + 1, n);
  const geometry::Blocker ball = geometry::blocking_ball(center, weight, first_weight_);
  double* row = table_.column(0) + n;
  const std::size_t step = table_.room();
  row[kX * step] = ball.center.x;
  row[kY * step] = ball.center.y;
  row[kZ * step] = ball.center.z;
  row[kWeight * step] = ball.weight;
  row[kSquare * step] = ball.square;
  row[kDistance * step] = ball.distance;
  row[kHalfPower * step] = ball.half_power;
  labels_.push_back(label);
}

void Blockers::measure(std::size_t count) {
  measure_all(columns(), whole_vectors(count), first_weight_, table_.column(kSquare), table_.column(kDistance),
              table_.column(kHalfPower));
}

void Blockers::sort() {
  std::vector<Ball> balls;
  balls.reserve(size());
  for (std::size_t n = 0; n < size(); ++n) balls.push_back((*this)[n]);
  std::sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.square < b.square; });
  restart(first_weight_);
  for (const Ball& ball : balls) add(ball.center, ball.weight, ball.label);
}

}  // namespace meniscus
