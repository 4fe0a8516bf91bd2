// SPDX-License-Identifier: BSD-3-Clause
// Repeats the frames of another trajectory.
#include "core/trajectory/repeated_frames.h"

#include <utility>

namespace meniscus {

RepeatedFrames::RepeatedFrames(std::unique_ptr<Trajectory> inner, std::uint64_t times)
    : Trajectory(inner->path(), inner->format()), inner_(std::move(inner)), times_(times) {
  atom_count_ = inner_->atom_count();
  frame_count_ = inner_->frame_count() * times;
  warnings_ = inner_->warnings();
  cut_short_ = inner_->cut_short();
}

}  // namespace meniscus
