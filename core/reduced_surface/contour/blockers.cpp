// SPDX-License-Identifier: BSD-3-Clause
// Finds the arcs of a circle that balls cover, for all balls at once where they leave at most one arc.
#include "core/reduced_surface/contour/blockers.h"

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

// The relation of a ball to a circle, as far as it can be decided without a half-plane.
constexpr std::int64_t kSurelyMisses = 0, kSurelyCovers = 1, kClose = -2;

MENISCUS_VECTOR_CLONES
void classify(const geometry::Circle& circle, double first_weight, double noise, const Blockers::Columns& balls,
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
  classify(circle, blockers.first_weight(), noise, blockers.columns(), room, near_.data());
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

namespace {

// A value beyond all differences of pseudo-angles: the begin and end of the arcs of balls that miss the circle.
constexpr double kBeyond = 9;

// The part that the widest arc leaves, [0, length] from its end on, and the part [low, high] of it that remains after
// arcs that cover one of these two ends.
struct Rest {
  double low;
  double high;
  double margin;  // the distance of any other end to these two
};

MENISCUS_VECTOR_CLONES
Rest turn_to_widest(const CircleMeetings::ArcColumns& arcs, std::size_t count, std::size_t widest, double* from_begin,
                    double* from_end) {
  const CircleMeetings::ArcColumns a = arcs;
  const double origin = a.end[widest], length = geometry::pseudo_sweep(origin, a.begin[widest]);
  std::int64_t low = 0, high = ordered_bits(length), margin = ordered_bits(4.0);
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    // Masks replace choices, because compilers would make branches of these.
    const std::int64_t cuts = a.meeting[n] == geometry::kCuts ? -1 : 0, beyond = ordered_bits(kBeyond) & ~cuts;
    const std::int64_t from_begin_bits = ordered_bits(geometry::pseudo_sweep(origin, a.begin[n]));
    const std::int64_t from_end_bits = ordered_bits(geometry::pseudo_sweep(origin, a.end[n]));
    const double b = from_ordered_bits((from_begin_bits & cuts) | beyond);
    const double e = from_ordered_bits((from_end_bits & cuts) | beyond);
    const double lower = e < b ? e : 0.0, past = e >= length ? b : length, upper = e < b ? b : past;
    const double b_ends = std::min(b, std::abs(4 - b)), e_ends = std::min(e, std::abs(4 - e));
    const double b_apart = std::min(b_ends, std::abs(b - length)), e_apart = std::min(e_ends, std::abs(e - length));
    const double apart = std::min(b_apart, e_apart), of_others = n == widest ? 4.0 : apart;
    from_begin[n] = b;
    from_end[n] = e;
    low = std::max(low, ordered_bits(lower));
    high = std::min(high, ordered_bits(upper));
    margin = std::min(margin, ordered_bits(of_others));
  }
  return {from_ordered_bits(low), from_ordered_bits(high), from_ordered_bits(margin)};
}

// The ends [low, high] of the remainder, pushed together by arcs that begin before one of them and end between them.
struct Push {
  double low;
  double high;
  std::int64_t inside;               // number of arcs that begin or end between them
  std::int64_t near_low, near_high;  // numbers of arc ends that coincide with low and high up to rounding
  std::int64_t low_arc,
      high_arc;  // sums of the numbers of the arcs that end at `low`, and of those that begin at `high`
};

MENISCUS_VECTOR_CLONES
Push push(const double* from_begin, const double* from_end, std::size_t count, double low, double high, double blur) {
  const double before_low = low - blur, behind_low = low + blur, before_high = high - blur, behind_high = high + blur;
  std::int64_t new_low = ordered_bits(low), new_high = ordered_bits(high), inside = 0, near_low = 0, near_high = 0,
               low_arc = 0, high_arc = 0;
  MENISCUS_INDEPENDENT_STEPS
  for (std::int64_t n = 0; n < static_cast<std::int64_t>(count); ++n) {
    const double b = from_begin[n], e = from_end[n];
    const double lower = b < before_low ? e : 0.0, upper = e > behind_high ? b : kBeyond;
    new_low = std::max(new_low, ordered_bits(lower));
    new_high = std::min(new_high, ordered_bits(upper));
    const bool within = (e > behind_low) & (b < before_high) & (b < e);
    const bool ends_low = std::abs(e - low) <= blur, begins_high = std::abs(b - high) <= blur;
    const bool begins_low = std::abs(b - low) <= blur, ends_high = std::abs(e - high) <= blur;
    inside += within ? 1 : 0;
    near_low += (ends_low ? 1 : 0) + (begins_low ? 1 : 0);
    near_high += (begins_high ? 1 : 0) + (ends_high ? 1 : 0);
    low_arc += ends_low ? n : 0;
    high_arc += begins_high ? n : 0;
  }
  return {from_ordered_bits(new_low), from_ordered_bits(new_high), inside, near_low, near_high, low_arc, high_arc};
}

}  // namespace

CircleSweep::Outcome CircleSweep::find(const CircleMeetings& meetings, const Blockers& blockers) {
  if (meetings.covered()) return Outcome::covered;
  if (meetings.any_doubtful()) return Outcome::unknown;
  if (meetings.none()) return Outcome::whole;
  from_.make_room(meetings.count());
  const double blur = 2 * meetings.error() + 16 * geometry::kUnitRoundoff;
  const Rest rest =
      turn_to_widest(meetings.arcs(), meetings.count(), meetings.widest(), from_.column(kBegin), from_.column(kEnd));
  if (!(rest.margin > blur)) return Outcome::unknown;
  return close_in(meetings, blockers, rest.low, rest.high, blur);
}

CircleSweep::Outcome CircleSweep::close_in(const CircleMeetings& meetings, const Blockers& blockers, double low,
                                           double high, double blur) {
  while (low < high) {
    const Push next = push(from_.column(kBegin), from_.column(kEnd), meetings.count(), low, high, blur);
    if (next.low > low || next.high < high) {
      low = next.low;
      high = next.high;
      continue;
    }
    if (next.inside > 0 || next.near_low != 1 || next.near_high != 1 || !(high - low > blur)) return Outcome::unknown;
    const auto before = static_cast<std::size_t>(next.low_arc), behind = static_cast<std::size_t>(next.high_arc);
    arc_ = {meetings.arc(before).end, meetings.arc(behind).begin, blockers.label(meetings.blocker(before)),
            blockers.label(meetings.blocker(behind))};
    return Outcome::one_arc;
  }
  return low > high + blur ? Outcome::covered : Outcome::unknown;
}

}  // namespace meniscus
