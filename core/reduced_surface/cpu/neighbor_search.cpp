// SPDX-License-Identifier: BSD-3-Clause
// Computes squared distances from balls to all around them, in loops that compilers vectorize.
#include "core/reduced_surface/cpu/neighbor_search.h"

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

// Copies balls and their places in whole vectors, which may be up to seven balls more than `count`.
MENISCUS_VECTOR_CLONES
void copy_balls(const BallColumns& from, std::uint32_t first, std::size_t count, const std::array<double*, 4>& columns,
                std::uint32_t* places) {
  const double *x = from.x + first, *y = from.y + first, *z = from.z + first, *radius = from.radius + first;
  double *to_x = columns[0], *to_y = columns[1], *to_z = columns[2], *to_radius = columns[3];
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < whole_vectors(count); ++n) {
    to_x[n] = x[n];
    to_y[n] = y[n];
    to_z[n] = z[n];
    to_radius[n] = radius[n];
    places[n] = first + static_cast<std::uint32_t>(n);
  }
}

// Computes, for each ball, a number that is negative if it overlaps a ball around (x, y, z) that reaches `reach` Å
// beyond van der Waals balls.
MENISCUS_VECTOR_CLONES
void sign_overlapping(const BallColumns& balls, std::size_t count, double x, double y, double z, double reach,
                      std::int64_t* overlaps) {
  const BallColumns b = balls;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < whole_vectors(count); ++n) {
    const double dx = b.x[n] - x, dy = b.y[n] - y, dz = b.z[n] - z, sum = reach + b.radius[n];
    overlaps[n] = dx * dx + dy * dy + dz * dz - sum * sum < 0 ? -1 : 0;
  }
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

// Finds the balls around those from `first` on that are as close to each other as the balls of one cell.
void NeighborSearch::surround(std::size_t first, Surroundings& around) const {
  glm::dvec3 low = center(first), high = low;
  double heaviest = weight(first);
  std::size_t past = first + 1;
  for (; past < size(); ++past) {
    const glm::dvec3 new_low = glm::min(low, center(past)), new_high = glm::max(high, center(past));
    const glm::dvec3 side = new_high - new_low;
    if (std::max({side.x, side.y, side.z}) > largest_radius_) break;
    low = new_low;
    high = new_high;
    heaviest = std::max(heaviest, weight(past));
  }
  around.first_ = first;
  around.past_ = past;
  around.count_ = 0;
  const glm::dvec3 middle = 0.5 * (low + high), half = high - middle;
  const double reach = std::sqrt(heaviest) + largest_radius_ + 1.001 * std::max({half.x, half.y, half.z});
  const BallColumns from{table_.column(kX), table_.column(kY), table_.column(kZ), table_.column(kRadius)};
  grid_.for_each_row_near(middle, reach, [&](std::uint32_t row, std::uint32_t row_end) {
    const std::size_t at = around.count_, count = row_end - row;
    around.make_room(at + count + kLanes);
    const auto to = [&](Surroundings::Column c) { return around.table_.column(c) + at; };
    copy_balls(from, row, count, {to(around.kX), to(around.kY), to(around.kZ), to(around.kRadius)},
               around.places_.data() + at);
    around.count_ += count;
  });
}

void NeighborSearch::append_neighbors(std::size_t place, Surroundings& around,
                                      std::vector<std::uint32_t>& neighbors) const {
  if (place < around.first_ || place >= around.past_) surround(place, around);
  const std::size_t count = around.count_, known = neighbors.size();
  const auto of = [&](Surroundings::Column c) { return around.table_.column(c); };
  const glm::dvec3 at = center(place);
  sign_overlapping({of(around.kX), of(around.kY), of(around.kZ), of(around.kRadius)}, count, at.x, at.y, at.z,
                   std::sqrt(weight(place)) + probe_radius_ + kGrowth, around.overlaps_.data());
  const std::uint32_t* listed = around.listed_.data();
  const std::uint32_t* past = list_negative(around.overlaps_.data(), count, 0, around.listed_.data());
  neighbors.resize(known + static_cast<std::size_t>(past - listed));
  std::uint32_t* to = neighbors.data() + known;
  for (; listed < past; ++listed) {
    *to = around.places_[*listed];
    to += *to != place ? 1 : 0;
  }
  neighbors.resize(static_cast<std::size_t>(to - neighbors.data()));
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
