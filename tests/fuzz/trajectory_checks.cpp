// SPDX-License-Identifier: BSD-3-Clause
// Checks the frames of trajectories.
#include "tests/fuzz/trajectory_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/structure/bonds.h"
#include "core/trajectory/trajectory.h"

namespace meniscus::fuzz {
namespace {

bool all_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::optional<Frame> read(Trajectory& trajectory, std::uint64_t number) {
  try {
    Frame frame;
    trajectory.read(number, frame);
    return frame;
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
  return std::nullopt;
}

void check_cell(const glm::dmat3& vectors) {
  for (int axis = 0; axis < 3; ++axis) require(all_finite(vectors[axis]), "boxes are finite");
  const std::optional<PeriodicCell> cell = PeriodicCell::of(vectors);
  if (!cell) return;
  const glm::dvec3 there(7.0, -3.0, 11.0), shortest = cell->shortest(there);
  require(all_finite(shortest) && glm::length(shortest) <= 1.000001 * glm::length(there),
          "the shortest image is no longer");
}

void check_frame(const Frame& frame, std::size_t atoms) {
  require(frame.positions.size() == atoms, "all frames have the atoms of the first");
  for (const glm::dvec3& position : frame.positions) {
    require(all_finite(position) && glm::length(position) <= 2.0 * kLargestCoordinate,
            "positions are finite and bounded");
  }
  require(!frame.time || std::isfinite(*frame.time), "times are finite");
  if (frame.cell) check_cell(*frame.cell);
}

void check_same(const std::optional<Frame>& a, const std::optional<Frame>& b) {
  require(a.has_value() == b.has_value(), "a frame can be read again, or never");
  if (!a) return;
  require(a->positions == b->positions && a->cell == b->cell && a->time == b->time && a->step == b->step,
          "a frame is the same whatever was read before");
}

}  // namespace

void check_trajectory(const TrajectoryFormat& format, const ScratchFile& scratch, std::string_view bytes) {
  constexpr std::uint64_t kMostFrames = 16;
  const std::string& path = scratch.write(bytes);
  format.recognizes(bytes.substr(0, kTrajectoryStart));
  std::unique_ptr<Trajectory> trajectory;
  try {
    trajectory = format.open(path, {});
  } catch (const InputError& error) {
    return require_clear(error);
  } catch (const CapacityError& error) {
    return require_clear(error);
  }
  require(trajectory->frame_count() > 0 && trajectory->frame_count() <= bytes.size() * 10'000,
          "there is a frame, and no more than the bytes can hold");
  const std::uint64_t frames = std::min(trajectory->frame_count(), kMostFrames);
  std::vector<std::optional<Frame>> read_first;
  for (std::uint64_t n = 0; n < frames; ++n) {
    read_first.push_back(read(*trajectory, n));
    if (read_first.back()) check_frame(*read_first.back(), trajectory->atom_count());
  }
  for (std::uint64_t n = frames; n-- > 0;) check_same(read_first[n], read(*trajectory, n));
  require(!read(*trajectory, trajectory->frame_count()), "there is no frame behind the last");
}

}  // namespace meniscus::fuzz
