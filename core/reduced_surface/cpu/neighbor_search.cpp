// SPDX-License-Identifier: BSD-3-Clause
// Computes squared distances for whole rows of cells, in loops that compilers vectorize.
#include "core/reduced_surface/cpu/neighbor_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/math/vector_loops.h"

namespace meniscus {
namespace {

constexpr double kGrowth = 2e-9;  // Å: at least what decisions add to two radii (reduced_surface.h)

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

// Runs a parallel loop with small steps, many per task.
template <typename Visit>
void for_each(std::size_t count, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) visit(n);
  });
}

std::vector<glm::dvec3> centers_of(std::span<const Ball> atoms, std::span<const std::uint32_t> kept) {
  std::vector<glm::dvec3> centers(kept.size());
  for_each(kept.size(), [&](std::size_t n) { centers[n] = atoms[kept[n]].center; });
  return centers;
}

struct BallColumns {
  const double *x, *y, *z, *radius;
};

// Lists the balls of some rows that overlap a ball around (x, y, z) of this SAS radius, without `self`; returns the end
// of the list.
MENISCUS_VECTOR_CLONES
std::uint32_t* list_overlapping(const BallColumns& balls, const NeighborSearch::Rows& rows, std::uint32_t self,
                                double x, double y, double z, double radius, double probe_radius, std::uint32_t* list) {
  constexpr std::uint32_t kMost = 64;  // balls of a row at once, in whole vectors
  std::int64_t overlaps[kMost];        // negative if the ball overlaps
  for (const auto& [row_first, last] : rows)
    for (std::uint32_t first = row_first; first < last; first += kMost) {
      const double *bx = balls.x + first, *by = balls.y + first, *bz = balls.z + first, *br = balls.radius + first;
      const std::uint32_t count = std::min(kMost, last - first);
      for (std::size_t n = 0; n < whole_vectors(count); ++n) {
        const double dx = bx[n] - x, dy = by[n] - y, dz = bz[n] - z;
        const double reach = radius + br[n] + probe_radius + kGrowth;
        overlaps[n] = dx * dx + dy * dy + dz * dz - reach * reach < 0 ? -1 : 0;
      }
      if (self - first < count) overlaps[self - first] = 0;
      list = list_negative(overlaps, count, first, list);
    }
  return list;
}

}  // namespace

NeighborSearch::NeighborSearch(std::span<const Ball> atoms, double probe_radius, std::span<const double> weights,
                               const std::vector<bool>& left_out)
    : probe_radius_(probe_radius),
      largest_radius_(largest_radius(atoms, probe_radius)),
      atom_(all_but(atoms.size(), left_out)),
      grid_(centers_of(atoms, atom_), largest_radius_) {
  const std::vector<std::uint32_t> kept = std::move(atom_);
  atom_.resize(kept.size());
  table_.make_room(atom_.size() + kLanes);  // room for whole vectors from any place on
  double *x = table_.column(kX), *y = table_.column(kY), *z = table_.column(kZ);
  double *radius = table_.column(kRadius), *weight = table_.column(kWeight);
  for_each(atom_.size(), [&](std::size_t place) {
    const std::uint32_t a = atom_[place] = kept[grid_.order()[place]];
    x[place] = atoms[a].center.x;
    y[place] = atoms[a].center.y;
    z[place] = atoms[a].center.z;
    radius[place] = atoms[a].radius;
    weight[place] = weights[a];
  });
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
  neighbors.resize(known + candidates + kLanes);
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
