// SPDX-License-Identifier: BSD-3-Clause
// Balls that may cover parts of circles around one first ball.
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

/// Columns of doubles, all of one length: what is one number of many things stands together.
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
  /// Starts anew for circles of a first ball with this weight.
  void restart(double first_weight);
  /// center: relative to the first ball's.
  void add(const glm::dvec3& center, double weight, std::uint32_t label);

  /// Starts anew with `count` balls: write(n, x, y, z, weight, label) fills in one.
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

  /// The same number of ball after ball, up to whole vectors: beyond size() anything may stand.
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

}  // namespace meniscus
