// SPDX-License-Identifier: BSD-3-Clause
// Progress and interruption of the current picture.
#pragma once

#include <thread>

#include <tbb/parallel_for.h>

#include "core/render/picture.h"

namespace meniscus {

/// Decides if the current picture is to be stopped. Keeps a reference to the caller's function, which must outlive it.
/// The caller's function is called on the caller's thread only.
class Interruption {
 public:
  explicit Interruption(const std::function<bool()>& stop) : stop_(stop) {}

  bool came() {
    if (stop_ && !came_ && std::this_thread::get_id() == caller_ && stop_()) came_ = true;
    return came_;
  }

  /// Notes how many of `samples` of this block are cast, from 0. Only the caller's thread may call it.
  void note(int sample, int samples) { block_share_ = static_cast<double>(sample) / samples; }
  double block_share() const { return block_share_; }

 private:
  double block_share_ = 0.0;
  const std::function<bool()>& stop_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<bool> came_ = false;
};

/// Reports the progress of a picture that is cast block by block.
class BlockProgress {
 public:
  BlockProgress(const RenderSettings& settings, std::size_t blocks) : blocks_(static_cast<double>(blocks)) {
    if (!settings.progress) return;
    tell_ = [this, &settings] {
      settings.progress(std::min((done_ + interruption_.block_share()) / blocks_, 1.0));
      return false;
    };
  }

  /// Returns the interruption of the current block.
  Interruption& interruption() { return interruption_; }
  void end_block() {
    ++done_;
    interruption_.note(0, 1);
  }

 private:
  double blocks_, done_ = 0.0;
  std::function<bool()> tell_;
  Interruption interruption_{tell_};
};

/// Calls work(n) for n < count on all threads until an interruption occurs.
template <typename Work>
void for_each_until(Interruption& interruption, int count, const Work& work) {
  tbb::parallel_for(0, count, [&](int n) {
    if (!interruption.came()) work(n);
  });
}

}  // namespace meniscus
