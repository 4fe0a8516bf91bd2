// SPDX-License-Identifier: BSD-3-Clause
// Squared distances of whole rows of cells, as loops over columns of numbers.
#include "core/reduced_surface/cpu/neighbor_search.h"

#include <algorithm>
#include <cmath>

#include "core/math/vector_clones.h"

namespace meniscus {
namespace {

constexpr double kGrowth = 2e-9;  // Å: not below what decisions grow two radii by, reduced_surface.h

double largest_radius(std::span<const Ball> atoms, double probe_radius) {
  double largest = 0;
  for (const Ball& b : atoms) largest = std::max(largest, b.radius + probe_radius);
  return largest + kGrowth;
}

std::vector<std::uint32_t> all_but(std::size_t count, const std::vector<bool>& left_out) {
  std::vector<std::uint32_t> kept;
  kept.reserve(count);
  for (std::uint32_t n = 0; n < count; ++n)
    if (!left_out[n]) kept.push_back(n);
  return kept;
}

std::vector<glm::dvec3> centers_of(std::span<const Ball> atoms, std::span<const std::uint32_t> kept) {
  std::vector<glm::dvec3> centers;
  centers.reserve(kept.size());
  for (const std::uint32_t a : kept) centers.push_back(atoms[a].center);
  return centers;
}

struct BallColumns {
  const double *x, *y, *z, *radius;
};

// Lists the balls of some rows that overlap a ball around (x, y, z) of this (SAS) radius, but not `self`; returns the
// end of the list.
MENISCUS_VECTOR_CLONES
std::uint32_t* list_overlapping(const BallColumns& balls, const NeighborSearch::Rows& rows, std::uint32_t self,
                                double x, double y, double z, double radius, double probe_radius, std::uint32_t* list) {
  constexpr std::uint32_t kMost = 64;  // of a row at once, up to whole vectors
  double gap[kMost];
  for (const auto& [row_first, last] : rows)
    for (std::uint32_t first = row_first; first < last; first += kMost) {
      const double *bx = balls.x + first, *by = balls.y + first, *bz = balls.z + first, *br = balls.radius + first;
      const std::uint32_t count = std::min(kMost, last - first);
      for (std::size_t n = 0; n < whole_vectors(count); ++n) {
        const double dx = bx[n] - x, dy = by[n] - y, dz = bz[n] - z;
        const double reach = radius + br[n] + probe_radius + kGrowth;
        gap[n] = dx * dx + dy * dy + dz * dz - reach * reach;
      }
      for (std::uint32_t n = 0; n < count; ++n) {
        *list = first + n;
        list += (gap[n] < 0) & (first + n != self);
      }
    }
  return list;
}

}  // namespace

NeighborSearch::NeighborSearch(std::span<const Ball> atoms, double probe_radius, std::span<const double> weights,
                               const std::vector<bool>& left_out)
    : probe_radius_(probe_radius),
      largest_radius_(largest_radius(atoms, probe_radius)),
      grid_(centers_of(atoms, all_but(atoms.size(), left_out)), largest_radius_),
      atom_(all_but(atoms.size(), left_out)) {
  std::vector<std::uint32_t> in_order;
  in_order.reserve(atom_.size());
  for (const std::uint32_t n : grid_.order()) in_order.push_back(atom_[n]);
  atom_ = std::move(in_order);
  table_.make_room(atom_.size() + kLanes);  // whole vectors from any place on
  for (std::size_t place = 0; place < atom_.size(); ++place) {
    const Ball& ball = atoms[atom_[place]];
    table_.column(kX)[place] = ball.center.x;
    table_.column(kY)[place] = ball.center.y;
    table_.column(kZ)[place] = ball.center.z;
    table_.column(kRadius)[place] = ball.radius;
    table_.column(kWeight)[place] = weights[atom_[place]];
  }
}

void NeighborSearch::append_neighbors(std::size_t place, Rows& rows, std::vector<std::uint32_t>& neighbors) const {
  const glm::dvec3 at = center(place);
  const double radius = std::sqrt(weight(place));
  rows.clear();
  std::size_t candidates = 0;
  grid_.for_each_row_near(at, radius + largest_radius_, [&](std::uint32_t first, std::uint32_t last) {
    if (first == last) return;
    rows.push_back({first, last});
    candidates += last - first;
  });
  const std::size_t known = neighbors.size();
  neighbors.resize(known + candidates);
  const BallColumns balls{table_.column(kX), table_.column(kY), table_.column(kZ), table_.column(kRadius)};
  std::uint32_t* past = list_overlapping(balls, rows, static_cast<std::uint32_t>(place), at.x, at.y, at.z, radius,
                                         probe_radius_, neighbors.data() + known);
  neighbors.resize(static_cast<std::size_t>(past - neighbors.data()));
}

void NeighborSearch::list_blockers(std::size_t place, std::span<const std::uint32_t> neighbors,
                                   Blockers& blockers) const {
  const glm::dvec3 at = center(place);
  const double *bx = table_.column(kX), *by = table_.column(kY), *bz = table_.column(kZ), *bw = table_.column(kWeight);
  blockers.assign(weight(place), neighbors.size(),
                  [&](std::size_t n, double& x, double& y, double& z, double& w, std::uint32_t& label) {
                    label = neighbors[n];
                    x = bx[label] - at.x;
                    y = by[label] - at.y;
                    z = bz[label] - at.z;
                    w = bw[label];
                  });
}

}  // namespace meniscus
