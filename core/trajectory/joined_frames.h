// SPDX-License-Identifier: BSD-3-Clause
// Several trajectories of the same atoms in a row, as one: a simulation that was continued.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/trajectory/trajectory.h"

namespace meniscus {

class JoinedFrames : public Trajectory {
 public:
  /// The frames of the first, then those of the second, and so on; all of them, also where one begins before the end of
  /// the last (then there is a warning). `parts`: at least one. Throws InputError where their atoms differ in number.
  explicit JoinedFrames(std::vector<std::unique_ptr<Trajectory>> parts);

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override;
  void warn_of_overlap(std::size_t part);

  std::vector<std::unique_ptr<Trajectory>> parts_;
  std::vector<std::uint64_t> begin_;  ///< of each part its first frame in all
};

}  // namespace meniscus
