// SPDX-License-Identifier: BSD-3-Clause
// The steps of the preparation, frame by frame.
#include "core/trajectory/prepared_frames.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/trajectory/superpose.h"

namespace meniscus {
namespace {

glm::dvec3 mean_of(const std::vector<glm::dvec3>& positions, const std::vector<std::uint32_t>& atoms) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t a : atoms) sum += positions[a];
  return sum / static_cast<double>(atoms.size());
}

}  // namespace

PreparedFrames::PreparedFrames(Trajectory& trajectory, Preparation preparation)
    : trajectory_(trajectory), preparation_(std::move(preparation)) {
  if (preparation_.superposed.empty() && preparation_.centered.empty()) return;
  Frame frame;
  read_placed(preparation_.reference, frame);  // moves nothing yet, as there is no reference
  reference_ = std::move(frame.positions);
}

void PreparedFrames::read_placed(std::uint64_t number, Frame& frame) {
  trajectory_.read(number, frame);
  std::vector<glm::dvec3>& positions = frame.positions;
  if (preparation_.whole) {
    const std::string where = fmt::format("{}: frame {}", trajectory_.path(), number);
    if (!frame.cell)
      throw InputError(where, 0, "has no periodic box, without which nothing can be made whole; leave --whole away");
    preparation_.whole->apply(*frame.cell, positions, where);
  }
  if (reference_.empty()) return;
  if (!preparation_.superposed.empty()) {
    const RigidMotion motion = superposition(reference_, positions, preparation_.superposed);
    for (glm::dvec3& x : positions) x = motion(x);
  }
  if (!preparation_.centered.empty()) {
    const glm::dvec3 shift = mean_of(reference_, preparation_.centered) - mean_of(positions, preparation_.centered);
    for (glm::dvec3& x : positions) x += shift;
  }
}

const Frame& PreparedFrames::placed(std::uint64_t number) {
  for (const Kept& kept : kept_)
    if (kept.number == number) return kept.frame;
  // One window of smoothing, and its neighbours for velocities.
  if (kept_.size() > 2 * preparation_.smooth_half + 3) kept_.pop_front();
  Kept fresh{number, {}};
  read_placed(number, fresh.frame);
  return kept_.emplace_back(std::move(fresh)).frame;
}

void PreparedFrames::read(std::uint64_t number, Frame& frame) {
  if (number >= trajectory_.frame_count()) return trajectory_.read(number, frame);  // says what is wrong
  const std::uint64_t half = std::min({preparation_.smooth_half, number, trajectory_.frame_count() - 1 - number});
  if (half == 0) {
    frame = placed(number);
    return;
  }
  std::vector<glm::dvec3> sum(trajectory_.atom_count(), glm::dvec3(0.0));
  for (std::uint64_t n = number - half; n <= number + half; ++n) {
    const Frame& one = placed(n);
    for (std::size_t a = 0; a < sum.size(); ++a) sum[a] += one.positions[a];
  }
  frame = placed(number);
  for (std::size_t a = 0; a < sum.size(); ++a) frame.positions[a] = sum[a] / static_cast<double>(2 * half + 1);
}

void PreparedFrames::read_velocities(std::uint64_t number, std::optional<std::uint64_t> before,
                                     std::optional<std::uint64_t> behind, std::vector<glm::dvec3>& velocities) {
  double steps = 0.0;
  // A damaged neighbour is an error of its own frame, not of this one.
  const auto read_neighbor = [&](std::optional<std::uint64_t> neighbor, Frame& frame) {
    try {
      read(neighbor.value_or(number), frame);
      if (neighbor) steps += 1.0;
    } catch (const InputError&) {
      read(number, frame);
    }
  };
  Frame first, last;
  read_neighbor(before, first);
  read_neighbor(behind, last);
  velocities.resize(first.positions.size());
  for (std::size_t a = 0; a < velocities.size(); ++a)
    velocities[a] = (last.positions[a] - first.positions[a]) / std::max(1.0, steps);
}

}  // namespace meniscus
