// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of circle.glsl for many balls at once: loops over columns of numbers, which compilers make vectors of.
#include "core/reduced_surface/contour/blockers.h"

#include <algorithm>
#include <span>

#include "core/math/vector_clones.h"

namespace meniscus {

namespace {

// How a ball meets a circle is a number among numbers, too: kMisses, kCuts, kCovers, or
constexpr double kInDoubt = 1.5;
static_assert(geometry::kMisses < geometry::kCuts && geometry::kCuts < kInDoubt && kInDoubt < geometry::kCovers);

struct MeetingColumns {
  double *meeting, *normal_x, *normal_y, *offset, *length_squared, *error;
};

MENISCUS_VECTOR_CLONES
void meet_all(const geometry::Circle& circle, double first_weight, double noise, const Blockers::Columns& balls,
              std::size_t count, const MeetingColumns& out) {
  const geometry::Circle c = circle;
  const Blockers::Columns b = balls;
  const MeetingColumns o = out;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec3 center(b.x[n], b.y[n], b.z[n]);
    double offset, margin;
    const bool apart = geometry::surely_apart(c, first_weight, noise, center, b.square[n], b.distance[n],
                                              b.half_power[n], geometry::kUnitRoundoff, offset);
    const geometry::HalfPlane h =
        geometry::covered_half_plane(c, first_weight, center, b.distance[n], b.weight[n], geometry::kUnitRoundoff);
    const double meeting = geometry::meet_circle(h, margin);
    const double sure = offset < 0 ? geometry::kCovers : geometry::kMisses;
    const double close = margin > 0 ? meeting : kInDoubt;
    o.meeting[n] = apart ? sure : close;
    o.normal_x[n] = h.normal.x;
    o.normal_y[n] = h.normal.y;
    o.offset[n] = h.offset;
    o.length_squared[n] = h.length_squared;
    o.error[n] = h.error;
  }
}

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

MENISCUS_VECTOR_CLONES
void cover_arcs(const double* normal_x, const double* normal_y, const double* offset, const double* length_squared,
                const double* error, std::size_t count, double* begin, double* end, double* arc_error) {
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const geometry::CoveredArc arc =
        geometry::covered_arc({{normal_x[n], normal_y[n]}, offset[n], length_squared[n], 0, error[n]});
    begin[n] = arc.begin;
    end[n] = arc.end;
    arc_error[n] = arc.error;
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

void CircleMeetings::find(const geometry::Circle& circle, double noise, const Blockers& blockers, std::size_t skip) {
  const std::size_t count = whole_vectors(blockers.size());
  meetings_.make_room(count);
  const auto met = [&](MeetingColumn c) { return meetings_.column(c); };
  meet_all(circle, blockers.first_weight(), noise, blockers.columns(), count,
           {met(kMeeting), met(kNormalX), met(kNormalY), met(kOffset), met(kLengthSquared), met(kError)});
  const std::span<double> meeting(met(kMeeting), blockers.size());
  if (skip < meeting.size()) meeting[skip] = geometry::kMisses;
  list_members(meeting);
  if (covered_) return;
  const auto cut = [&](MeetingColumn c) { return cutting_.column(c); };
  arcs_.make_room(cutting_.room());
  cover_arcs(cut(kNormalX), cut(kNormalY), cut(kOffset), cut(kLengthSquared), cut(kError),
             whole_vectors(members_.size()), arcs_.column(kBegin), arcs_.column(kEnd), arcs_.column(kArcError));
}

std::size_t CircleMeetings::widest() const {
  const double *begin = arcs_.column(kBegin), *end = arcs_.column(kEnd);
  const std::size_t all = count();
  std::size_t widest = 0;
  double most = -1;
  for (std::size_t n = 0; n < all; ++n) {
    const double sweep = geometry::pseudo_sweep(begin[n], end[n]);
    widest = sweep > most ? n : widest;
    most = std::max(most, sweep);
  }
  return widest;
}

// Leaves out the balls that miss the circle.
void CircleMeetings::list_members(std::span<const double> meeting) {
  members_.resize(meeting.size());
  std::uint32_t* next = members_.data();
  bool covered = false;
  for (std::size_t n = 0; n < meeting.size(); ++n) {
    *next = static_cast<std::uint32_t>(n);
    next += meeting[n] > geometry::kMisses;
    covered |= meeting[n] > kInDoubt;
  }
  covered_ = covered;
  if (covered) return;
  const std::size_t kept = static_cast<std::size_t>(next - members_.data());
  members_.resize(kept);
  cutting_.make_room(kept);
  const std::uint32_t* member = members_.data();
  for (std::size_t c = 0; c < kMeetingColumns; ++c) {
    const double* from = meetings_.column(c);
    double* to = cutting_.column(c);
    for (std::size_t k = 0; k < kept; ++k) to[k] = from[member[k]];
  }
}

}  // namespace meniscus
