// SPDX-License-Identifier: BSD-3-Clause
// Balls that may cover parts of circles around one first ball, and the arcs of one circle that they cover.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/geometry.h"

namespace meniscus {

/// How many doubles the widest vector unit takes at once; lists of numbers are filled up to a multiple of it.
inline constexpr std::size_t kLanes = 8;

/// That multiple.
constexpr std::size_t whole_vectors(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Columns of doubles, all of one length: one number of many balls is contiguous.
template <std::size_t kColumns>
class ColumnTable {
 public:
  double* column(std::size_t c) { return numbers_.data() + c * room_; }
  const double* column(std::size_t c) const { return numbers_.data() + c * room_; }
  std::size_t room() const { return room_; }

  /// Room for `count` rows in whole vectors; the first `kept` rows stay.
  void make_room(std::size_t count, std::size_t kept = 0) {
    if (count <= room_) return;
    const std::size_t room = whole_vectors(std::max(count, 2 * room_));
    std::vector<double> numbers(kColumns * room);
    for (std::size_t c = 0; c < kColumns; ++c) std::copy_n(column(c), kept, numbers.data() + c * room);
    numbers_.swap(numbers);
    room_ = room;
  }

 private:
  std::vector<double> numbers_;
  std::size_t room_ = 0;
};

/// Balls that may cover parts of circles around one first ball.
class Blockers {
 public:
  /// Starts again for circles of a first ball with this weight.
  void restart(double first_weight);
  /// center: relative to the first ball's.
  void add(const glm::dvec3& center, double weight, std::uint32_t label);

  /// Starts again with `count` balls: write(n, x, y, z, weight, label) fills in one.
  template <typename Write>
  void assign(double first_weight, std::size_t count, const Write& write) {
    first_weight_ = first_weight;
    table_.make_room(count);
    labels_.resize(count);
    double *x = table_.column(kX), *y = table_.column(kY), *z = table_.column(kZ), *weight = table_.column(kWeight);
    for (std::size_t n = 0; n < count; ++n) write(n, x[n], y[n], z[n], weight[n], labels_[n]);
    measure(count);
  }

  /// Nearest first: near balls cover most, and a covered circle is done with.
  void sort();

  struct Ball : geometry::Blocker {
    std::uint32_t label;
  };
  std::size_t size() const { return labels_.size(); }
  Ball operator[](std::size_t n) const { return {row(n), labels_[n]}; }
  std::uint32_t label(std::size_t n) const { return labels_[n]; }
  double first_weight() const { return first_weight_; }

  /// The same number of ball after ball, up to whole vectors: beyond size() anything may be.
  struct Columns {
    const double *x, *y, *z, *weight, *square, *distance, *half_power;
  };
  Columns columns() const {
    const auto of = [&](Column c) { return table_.column(c); };
    return {of(kX), of(kY), of(kZ), of(kWeight), of(kSquare), of(kDistance), of(kHalfPower)};
  }

 private:
  void measure(std::size_t count);

  enum Column : std::size_t { kX, kY, kZ, kWeight, kSquare, kDistance, kHalfPower, kColumnCount };

  geometry::Blocker row(std::size_t n) const {
    const auto at = [&](Column c) { return table_.column(c)[n]; };
    return {{at(kX), at(kY), at(kZ)}, at(kWeight), at(kSquare), at(kDistance), at(kHalfPower)};
  }

  double first_weight_ = 0;
  ColumnTable<kColumnCount> table_;
  std::vector<std::uint32_t> labels_;
};

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
