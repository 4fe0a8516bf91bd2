// SPDX-License-Identifier: BSD-3-Clause
// Finds the balls that overlap a ball: tests the balls in the grid's cells around it, many at once.
#pragma once

#include "core/math/ball.h"
#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// The SAS balls of atoms in the order of a grid's cells, so that neighbours are near each other in the cache. A place
/// is an index in this order.
class NeighborSearch {
 public:
  /// atoms: van der Waals balls; weights: decision weights; atoms left out are not neighbours and have none.
  NeighborSearch(std::span<const Ball> atoms, double probe_radius, std::span<const double> weights,
                 const std::vector<bool>& left_out);

  std::size_t size() const { return atom_.size(); }
  std::uint32_t atom(std::size_t place) const { return atom_[place]; }
  double weight(std::size_t place) const { return table_.column(kWeight)[place]; }

  /// The balls around a few balls that are close to each other. An object is reused to save allocations.
  class Surroundings {
    friend class NeighborSearch;
    enum Column : std::size_t { kX, kY, kZ, kRadius, kColumnCount };

    void make_room(std::size_t count) {
      if (count <= table_.room()) return;
      table_.make_room(count, count_);
      places_.resize(table_.room());
      overlaps_.resize(table_.room());
      listed_.resize(table_.room());
    }

    std::size_t first_ = 0, past_ = 0;   // places of these few
    std::size_t count_ = 0;              // number of balls around them
    std::vector<std::uint32_t> places_;  // per ball around them
    ColumnTable<kColumnCount> table_;
    std::vector<std::int64_t> overlaps_;  // scratch
    std::vector<std::uint32_t> listed_;
  };

  /// Appends the places of all balls that overlap the ball at `place`, or come within rounding of it. `around` is kept
  /// from one place to the next.
  void append_neighbors(std::size_t place, Surroundings& around, std::vector<std::uint32_t>& neighbors) const;

  /// Lists these balls as blockers around the ball at `place`; their labels are their places.
  void list_blockers(std::size_t place, std::span<const std::uint32_t> neighbors, Blockers& blockers) const;

 private:
  enum Column : std::size_t { kX, kY, kZ, kRadius, kWeight, kColumnCount };

  void surround(std::size_t first, Surroundings& around) const;

  glm::dvec3 center(std::size_t place) const {
    return {table_.column(kX)[place], table_.column(kY)[place], table_.column(kZ)[place]};
  }

  double probe_radius_;
  double largest_radius_;  // largest radius of the SAS balls
  std::vector<std::uint32_t> atom_;
  BallGrid grid_;
  ColumnTable<kColumnCount> table_;
};

}  // namespace meniscus
