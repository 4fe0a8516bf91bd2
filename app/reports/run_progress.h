// SPDX-License-Identifier: BSD-3-Clause
// The progress of a run of frames, or of files: a bar, plain lines, JSON lines, or the lines of OpenJD.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/options/scene_options.h"

namespace meniscus {

/// Reports the progress of one run; for one thread.
class RunProgress {
 public:
  /// at_once: number of frames at work at the same time. word: the word for a frame here.
  RunProgress(ProgressStyle style, bool quiet, std::uint64_t frames, std::size_t at_once = 1,
              const char* word = "frame");

  /// Reports a finished frame. empty: its picture shows nothing.
  void done(std::uint64_t frame, const std::vector<std::string>& files, double milliseconds, bool empty = false);
  void failed(std::uint64_t frame, int exit_code, const std::string& message);
  /// Prints a line for people about what delays the run.
  void tell(const std::string& line) const;
  /// Must be called after the last frame, in case of failure, too.
  void end();

 private:
  void advance();

  ProgressStyle style_;
  const std::string word_;
  std::uint64_t total_, done_ = 0, failed_ = 0;
  int last_tenth_ = -1;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace meniscus
