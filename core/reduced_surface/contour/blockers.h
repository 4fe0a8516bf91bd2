// SPDX-License-Identifier: BSD-3-Clause
// Balls that may cover parts of the circles around one ball, the arcs of a circle that they cover, and a quick and safe
// decision whether all of a sphere is covered: most atoms and circles are, and need no more work.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/double_geometry.h"

namespace meniscus {

/// The number of doubles in the widest vector unit; lists of numbers are padded to a multiple of it.
inline constexpr std::size_t kLanes = 8;

/// Rounds a count up to whole vectors.
constexpr std::size_t whole_vectors(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Columns of doubles, all of one length: one number of many balls is contiguous.
template <std::size_t kColumns>
class ColumnTable {
 public:
  double* column(std::size_t c) { return numbers_.data() + c * room_; }
  const double* column(std::size_t c) const { return numbers_.data() + c * room_; }
  std::size_t room() const { return room_; }

  /// Makes room for `count` rows in whole vectors; the first `kept` rows stay.
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
  /// Adds a ball. center: relative to the first ball's.
  void add(const glm::dvec3& center, double weight, std::uint32_t label);

  /// Starts again with `count` balls: write(n, x, y, z, weight, label) writes one.
  template <typename Write>
  void assign(double first_weight, std::size_t count, const Write& write) {
    first_weight_ = first_weight;
    table_.make_room(count);
    labels_.resize(count);
    double *x = table_.column(kX), *y = table_.column(kY), *z = table_.column(kZ), *weight = table_.column(kWeight);
    for (std::size_t n = 0; n < count; ++n) write(n, x[n], y[n], z[n], weight[n], labels_[n]);
    measure(count);
  }

  /// Sorts the nearest balls first: near balls cover most, and a covered circle needs no more tests.
  void sort();

  struct Ball : geometry::Blocker {
    std::uint32_t label;
  };
  std::size_t size() const { return labels_.size(); }
  Ball operator[](std::size_t n) const { return {row(n), labels_[n]}; }
  std::uint32_t label(std::size_t n) const { return labels_[n]; }
  double first_weight() const { return first_weight_; }

  /// Columns with one number of all balls, padded to whole vectors: entries beyond size() are undefined.
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

/// The relations of balls to one circle, computed for all balls at once by the same arithmetic as for one after another
/// (contour.glsl, block()). Most balls surely miss it, and are not listed. An object is reused from circle to circle to
/// save allocations.
class CircleMeetings {
 public:
  /// Tests all blockers but the one at index `skip`. unit: the relative error to assume for numbers.
  void find(const geometry::Circle& circle, double unit, const Blockers& blockers, std::size_t skip);

  /// True if some ball surely covers all of the circle.
  bool covered() const { return most_.meeting > kInDoubt; }
  /// True if rounding may hide how some ball meets a circle that is not covered().
  bool any_doubtful() const { return most_.meeting > geometry::kCuts; }
  /// True if all balls miss the circle.
  bool none() const { return most_.meeting < geometry::kCuts; }

  /// Returns the number of listed balls, in the order of the blockers and padded to whole vectors: the last ones may
  /// miss the circle.
  std::size_t count() const { return count_; }
  /// Returns the index of the n-th listed ball among the blockers.
  std::size_t blocker(std::size_t n) const { return ball_[n]; }
  /// True if the ball cuts the circle, or may do so.
  bool meets(std::size_t n) const { return table_.column(kMeeting)[n] > geometry::kMisses; }
  /// True if rounding may hide how the ball meets the circle.
  bool doubtful(std::size_t n) const { return table_.column(kMeeting)[n] > geometry::kCuts; }
  geometry::CoveredArc arc(std::size_t n) const {
    return {table_.column(kBegin)[n], table_.column(kEnd)[n], table_.column(kError)[n]};
  }

  /// Columns of the listed balls: `meeting` is kCuts where the ball surely cuts the circle, and then the arc is valid.
  struct ArcColumns {
    const double *meeting, *begin, *end;
  };
  ArcColumns arcs() const { return {table_.column(kMeeting), table_.column(kBegin), table_.column(kEnd)}; }
  /// Returns a bound on the error of all ends of arcs of balls that surely cut the circle.
  double error() const { return most_.error; }
  /// Returns the place of the arc that covers most of the circle; some ball must surely cut it.
  std::size_t widest() const;

 private:
  // How a ball meets a circle is stored as a number like the others: kMisses, kCuts, kCovers, or this value for doubt.
  static constexpr double kInDoubt = 1.5;
  static_assert(geometry::kMisses < geometry::kCuts && geometry::kCuts < kInDoubt && kInDoubt < geometry::kCovers);

  enum Column : std::size_t { kX, kY, kZ, kWeight, kDistance, kMeeting, kBegin, kEnd, kError, kSweep, kColumnCount };

  // The largest value of each number. Only arcs of balls that surely cut the circle count.
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
  std::vector<std::uint32_t> ball_;  // the blocker at each place of the table
  ColumnTable<kColumnCount> table_;
  Most most_{};
};

/// The remainder of one circle under a union of covered arcs, seen from the end of the widest arc. An object is reused
/// from circle to circle to save allocations.
class CircleSweep {
 public:
  enum class Outcome {
    unknown,  ///< rounding leaves doubt, or there are several arcs
    whole,    ///< no ball covers any part of it
    covered,
    one_arc
  };

  /// Finds the remainder. meetings: the meetings of these blockers with the circle.
  Outcome find(const CircleMeetings& meetings, const Blockers& blockers);

  /// Returns the remaining arc after Outcome::one_arc, between the same pseudo-angles as by one ball after another.
  const geometry::ExposedArc& arc() const { return arc_; }

 private:
  Outcome close_in(const CircleMeetings& meetings, const Blockers& blockers, double low, double high, double blur);

  enum Column : std::size_t { kBegin, kEnd, kColumnCount };
  ColumnTable<kColumnCount> from_;  // per blocker: pseudo-angles of its covered arc from the end of the widest one
  geometry::ExposedArc arc_{};
};

/// The part of a first ball's sphere that other balls surely cover. An object is reused from sphere to sphere.
///
/// A sphere is sampled in 252 directions, so dense that every point lies within a known angle of one. A direction
/// counts as covered when one ball covers everything within that angle of it, with an allowance for rounding; so
/// "covered" is certain, and "not covered" only means that a precise test is needed. Where few directions are left, it
/// looks closer at denser directions around them.
class SphereCover {
 public:
  static constexpr std::size_t kPadded = 256;  ///< the number of directions, in whole blocks

  /// Tests the sphere of the blockers' first ball. False if all of it is surely covered: then nothing else is known.
  bool test(const Blockers& blockers);

  /// False if no point of the circle of the sphere and the n-th blocker lies near an uncovered direction: then all of
  /// the circle is covered. Valid after test() returned true.
  bool circle_may_be_exposed(std::size_t n) const { return signs_[n] >= 0; }

  /// Returns the numbers of the directions that are not surely covered. Valid after test() returned true.
  std::span<const std::uint8_t> uncovered() const { return {uncovered_numbers_.data(), uncovered_count_}; }

  /// True if a point of the sphere, given as a unit vector from its centre, is near one of these directions. All other
  /// points are surely covered. Only balls whose circles may be exposed cover points near the directions: the cap of
  /// any other ball neither contains such a direction nor comes as near to it. So if only these balls are applied to a
  /// circle, each remaining arc is exposed as a whole if its middle is near, and covered as a whole if not.
  static bool is_near(const glm::dvec3& point, std::span<const std::uint8_t> uncovered);

 private:
  static constexpr std::size_t kCapColumns = 5;

  // A cap of the sphere by its axis and its angle.
  struct Cap {
    glm::dvec3 axis;
    double cosine, sine;
  };

  void list_caps(const std::int16_t* limit, std::size_t count);
  bool is_covered_closely(const Blockers& blockers);
  bool is_covered_around(const glm::dvec3& direction, std::size_t look);
  void list_uncovered(const std::int16_t* x, const std::int16_t* y, const std::int16_t* z, std::size_t count,
                      std::uint32_t* list);

  std::vector<std::int32_t> products_;  // per blocker: axis and limits of products with it (Caps), column by column
  std::vector<std::int16_t> circles_;   // the same in 16 bits
  std::vector<std::uint32_t> caps_;     // the blockers whose caps cover something, the wide ones first
  std::size_t cap_count_ = 0, wide_count_ = 0;  // numbers of caps, in whole steps
  std::array<std::array<std::int16_t, kPadded>, 3> uncovered_{};
  std::array<std::uint8_t, kPadded> uncovered_numbers_{};
  std::size_t uncovered_count_ = 0;
  std::vector<std::int16_t> signs_;
  std::vector<Cap> caps_left_;  // caps whose circles may be exposed
  std::size_t latest_ = 0;      // the latest of them that covered a direction
  // Scratch: the directions outside the wide caps, and the places in this list of those outside all caps.
  std::array<std::uint32_t, kPadded + kLanes> outside_wide_{}, outside_all_{};
};

}  // namespace meniscus
