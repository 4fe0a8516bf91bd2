// SPDX-License-Identifier: BSD-3-Clause
// A trajectory in slow motion: each frame several times, so that a camera can move about a molecule that does not.
#pragma once

#include <memory>

#include "core/trajectory/trajectory.h"

namespace meniscus {

class RepeatedFrames : public Trajectory {
 public:
  /// Frame n is frame n / times of `inner`. times >= 1.
  RepeatedFrames(std::unique_ptr<Trajectory> inner, std::uint64_t times);

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override { inner_->read(number / times_, frame); }

  std::unique_ptr<Trajectory> inner_;
  std::uint64_t times_;
};

}  // namespace meniscus
