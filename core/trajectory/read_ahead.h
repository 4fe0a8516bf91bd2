// SPDX-License-Identifier: BSD-3-Clause
// Frames read on a thread of their own while others are worked on.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/trajectory/trajectory.h"

namespace meniscus {

/// A frame as it was read, or why it could not be.
struct ReadFrame {
  std::uint64_t number = 0;
  Frame frame;
  std::vector<glm::dvec3> velocities;  ///< Å per frame; empty unless the reader fills them in
  std::exception_ptr error;            ///< then the rest is worthless
};

class ReadAhead {
 public:
  /// Calls `read` for each number in order, on its thread, `depth` frames ahead at most.
  ReadAhead(std::function<void(ReadFrame&)> read, std::vector<std::uint64_t> numbers, std::size_t depth = 3);
  /// Waits for the frame that is being read.
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// The next frame, as soon as it is there; nothing behind the last.
  std::optional<ReadFrame> next();

 private:
  void work();

  std::function<void(ReadFrame&)> read_;
  std::vector<std::uint64_t> numbers_;
  std::size_t depth_, taken_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ReadFrame> ready_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace meniscus
