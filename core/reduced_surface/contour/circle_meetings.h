// SPDX-License-Identifier: BSD-3-Clause
// How all balls around a first one meet one circle, and the arcs of it that they cover.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/geometry.h"
#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// How balls meet one circle, all at once, by the same arithmetic as one ball after the other (contour.glsl, block()).
/// Most surely miss it, and are not listed. Reused from circle to circle to save allocations.
class CircleMeetings {
 public:
  /// The blocker at index `skip` is ignored. unit: by which numbers are taken to be off, relative.
  void find(const geometry::Circle& circle, double unit, const Blockers& blockers, std::size_t skip);

  /// Some ball surely covers all of the circle.
  bool covered() const { return most_.meeting > kInDoubt; }
  /// Rounding may hide how some ball meets the circle that is not covered().
  bool any_doubtful() const { return most_.meeting > geometry::kCuts; }
  /// All balls miss the circle.
  bool none() const { return most_.meeting < geometry::kCuts; }

  /// How many balls are listed, in the order of the blockers and up to whole vectors: those behind them miss the
  /// circle.
  std::size_t count() const { return count_; }
  /// Which blocker the n-th is.
  std::size_t blocker(std::size_t n) const { return ball_[n]; }
  /// It cuts the circle, or may do so.
  bool meets(std::size_t n) const { return table_.column(kMeeting)[n] > geometry::kMisses; }
  /// Rounding may hide how it meets the circle.
  bool doubtful(std::size_t n) const { return table_.column(kMeeting)[n] > geometry::kCuts; }
  geometry::CoveredArc arc(std::size_t n) const {
    return {table_.column(kBegin)[n], table_.column(kEnd)[n], table_.column(kError)[n]};
  }

  /// The numbers of ball after ball: kCuts where it surely cuts the circle, and its arc then.
  struct ArcColumns {
    const double *meeting, *begin, *end;
  };
  ArcColumns arcs() const { return {table_.column(kMeeting), table_.column(kBegin), table_.column(kEnd)}; }
  /// Bound on the error of all ends of arcs of balls that surely cut the circle.
  double error() const { return most_.error; }
  /// The place of that which covers most of the circle; some ball surely cuts it.
  std::size_t widest() const;

 private:
  // How a ball meets a circle is a number among numbers, too: kMisses, kCuts, kCovers, or
  static constexpr double kInDoubt = 1.5;
  static_assert(geometry::kMisses < geometry::kCuts && geometry::kCuts < kInDoubt && kInDoubt < geometry::kCovers);

  enum Column : std::size_t { kX, kY, kZ, kWeight, kDistance, kMeeting, kBegin, kEnd, kError, kSweep, kColumnCount };

  // The largest of each number. Arcs count whose balls surely cut the circle.
  struct Most {
    double meeting, error, sweep;
  };
  struct Columns {
    double *meeting, *begin, *end, *error, *sweep;
  };
  struct CloseBalls {
    const double *x, *y, *z, *weight, *distance;
  };
  bool list_close(const geometry::Circle& circle, double noise, const Blockers& blockers, std::size_t skip);
  static void meet_all(const geometry::Circle& circle, double unit, double first_weight, const CloseBalls& balls,
                       std::size_t count, const Columns& out);
  static Most find_most(const Columns& columns, std::size_t count);

  std::size_t count_ = 0;
  std::vector<std::int64_t> near_;   // per blocker
  std::vector<std::uint32_t> ball_;  // which blocker is the n-th in the table
  ColumnTable<kColumnCount> table_;
  Most most_{};
};

}  // namespace meniscus
