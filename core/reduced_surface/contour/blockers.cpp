// SPDX-License-Identifier: BSD-3-Clause
// Arranges the balls around a first one for vectorized loops, and intersects all of them with one circle.
#include "core/reduced_surface/contour/blockers.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/math/list_negative.h"
#include "core/math/vector_loops.h"

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

namespace {

// How a ball meets a circle, as far as it can be decided without a half-plane.
constexpr std::int64_t kSurelyMisses = 0, kSurelyCovers = 1, kClose = -2;

MENISCUS_VECTOR_CLONES
void tell_apart(const geometry::Circle& circle, double first_weight, double noise, const Blockers::Columns& balls,
                std::size_t count, std::int64_t* out) {
  const geometry::Circle c = circle;
  const Blockers::Columns b = balls;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    double offset;
    const bool apart = geometry::surely_apart(c, first_weight, noise, {b.x[n], b.y[n], b.z[n]}, b.square[n],
                                              b.distance[n], b.half_power[n], geometry::kUnitRoundoff, offset);
    const std::int64_t sure = offset < 0 ? kSurelyCovers : kSurelyMisses;
    out[n] = apart ? sure : kClose;
  }
}

}  // namespace

MENISCUS_VECTOR_CLONES
void CircleMeetings::meet_all(const geometry::Circle& circle, double unit, double first_weight, const CloseBalls& balls,
                              std::size_t count, const Columns& out) {
  const geometry::Circle c = circle;
  const CloseBalls b = balls;
  const Columns o = out;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    double margin;
    const geometry::HalfPlane h =
        geometry::covered_half_plane(c, first_weight, {b.x[n], b.y[n], b.z[n]}, b.distance[n], b.weight[n], unit);
    const double meeting = geometry::meet_circle(h, margin);
    const geometry::CoveredArc arc = geometry::covered_arc(h);
    o.meeting[n] = margin > 0 ? meeting : kInDoubt;
    o.begin[n] = arc.begin;
    o.end[n] = arc.end;
    o.error[n] = arc.error;
  }
}

// Masks replace choices, because compilers would make branches of these.
MENISCUS_VECTOR_CLONES
CircleMeetings::Most CircleMeetings::find_most(const Columns& columns, std::size_t count) {
  const Columns c = columns;
  std::int64_t meeting = 0, error = 0, widest = 0;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const std::int64_t cuts = c.meeting[n] == geometry::kCuts ? -1 : 0;
    const std::int64_t sweep = ordered_bits(geometry::pseudo_sweep(c.begin[n], c.end[n])) & cuts;
    meeting = std::max(meeting, ordered_bits(c.meeting[n]));
    error = std::max(error, ordered_bits(c.error[n]) & cuts);
    widest = std::max(widest, sweep);
    c.sweep[n] = from_ordered_bits(sweep);
  }
  return {from_ordered_bits(meeting), from_ordered_bits(error), from_ordered_bits(widest)};
}

bool CircleMeetings::list_close(const geometry::Circle& circle, double noise, const Blockers& blockers,
                                std::size_t skip) {
  const std::size_t size = blockers.size(), room = whole_vectors(size);
  if (near_.size() < room) {
    near_.resize(room);
    ball_.resize(room + kLanes);
  }
  tell_apart(circle, blockers.first_weight(), noise, blockers.columns(), room, near_.data());
  if (skip < size) near_[skip] = kSurelyMisses;
  std::int64_t all = 0;
  for (std::size_t n = 0; n < size; ++n) all |= near_[n];
  if ((all & kSurelyCovers) != 0) return false;
  count_ = static_cast<std::size_t>(list_negative(near_.data(), size, 0, ball_.data()) - ball_.data());
  return true;
}

void CircleMeetings::find(const geometry::Circle& circle, double unit, const Blockers& blockers, std::size_t skip) {
  if (!list_close(circle, geometry::half_plane_noise(circle, unit), blockers, skip)) {
    count_ = 0;
    most_ = {geometry::kCovers, 0, 0};
    return;
  }
  const std::size_t close = count_;
  count_ = whole_vectors(close);
  table_.make_room(count_);
  const auto of = [&](Column c) { return table_.column(c); };
  const Blockers::Columns from = blockers.columns();
  double *x = of(kX), *y = of(kY), *z = of(kZ), *weight = of(kWeight), *distance = of(kDistance);
  std::fill(ball_.begin() + static_cast<std::ptrdiff_t>(close), ball_.begin() + static_cast<std::ptrdiff_t>(count_),
            0u);
  for (std::size_t n = 0; n < count_; ++n) {
    const std::size_t ball = ball_[n];
    x[n] = from.x[ball];
    y[n] = from.y[ball];
    z[n] = from.z[ball];
    weight[n] = from.weight[ball];
    distance[n] = from.distance[ball];
  }
  const Columns columns{of(kMeeting), of(kBegin), of(kEnd), of(kError), of(kSweep)};
  meet_all(circle, unit, blockers.first_weight(), {x, y, z, weight, distance}, count_, columns);
  std::fill(columns.meeting + close, columns.meeting + count_, geometry::kMisses);
  most_ = find_most(columns, count_);
}

std::size_t CircleMeetings::widest() const {
  const double* sweep = table_.column(kSweep);
  return static_cast<std::size_t>(std::find(sweep, sweep + count_, most_.sweep) - sweep);
}

}  // namespace meniscus
