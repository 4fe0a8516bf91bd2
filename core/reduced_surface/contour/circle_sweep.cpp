// SPDX-License-Identifier: BSD-3-Clause
// Computes a union of arcs by its outermost ends, in loops over columns of numbers that compilers vectorize.
#include "core/reduced_surface/contour/circle_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/vector_loops.h"

namespace meniscus {
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
