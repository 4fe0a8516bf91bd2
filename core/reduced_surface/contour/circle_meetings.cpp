// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of circle.glsl for many balls at once: loops over columns of numbers, which compilers make vectors of.
#include "core/reduced_surface/contour/circle_meetings.h"

#include <algorithm>
#include <cstdint>

#include "core/math/ordered_bits.h"
#include "core/math/vector_clones.h"

namespace meniscus {

MENISCUS_VECTOR_CLONES
void CircleMeetings::meet_all(const geometry::Circle& circle, double first_weight, double noise,
                              const Blockers::Columns& balls, std::size_t count, const Columns& out) {
  const geometry::Circle c = circle;
  const Blockers::Columns b = balls;
  const Columns o = out;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec3 center(b.x[n], b.y[n], b.z[n]);
    double offset, margin;
    const bool apart = geometry::surely_apart(c, first_weight, noise, center, b.square[n], b.distance[n],
                                              b.half_power[n], geometry::kUnitRoundoff, offset);
    const geometry::HalfPlane h =
        geometry::covered_half_plane(c, first_weight, center, b.distance[n], b.weight[n], geometry::kUnitRoundoff);
    const double meeting = geometry::meet_circle(h, margin);
    const geometry::CoveredArc arc = geometry::covered_arc(h);
    const double sure = offset < 0 ? geometry::kCovers : geometry::kMisses;
    const double close = margin > 0 ? meeting : kInDoubt;
    o.meeting[n] = apart ? sure : close;
    o.begin[n] = arc.begin;
    o.end[n] = arc.end;
    o.error[n] = arc.error;
  }
}

// Masks instead of choices: compilers would make branches of these.
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

void CircleMeetings::find(const geometry::Circle& circle, double noise, const Blockers& blockers, std::size_t skip) {
  count_ = whole_vectors(blockers.size());
  table_.make_room(count_);
  const auto of = [&](Column c) { return table_.column(c); };
  const Columns columns{of(kMeeting), of(kBegin), of(kEnd), of(kError), of(kSweep)};
  meet_all(circle, blockers.first_weight(), noise, blockers.columns(), count_, columns);
  if (skip < count_) columns.meeting[skip] = geometry::kMisses;
  std::fill(columns.meeting + blockers.size(), columns.meeting + count_, geometry::kMisses);
  most_ = find_most(columns, count_);
}

std::size_t CircleMeetings::widest() const {
  const double* sweep = table_.column(kSweep);
  return static_cast<std::size_t>(std::find(sweep, sweep + count_, most_.sweep) - sweep);
}

}  // namespace meniscus
