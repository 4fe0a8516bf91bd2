// SPDX-License-Identifier: BSD-3-Clause
// How a run of frames tells how far it is: a bar, plain lines, JSON lines, or the lines of OpenJD.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace meniscus {

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else plain lines
  bar,
  plain,   ///< a line at every tenth
  json,    ///< a JSON object a line on standard error: start, each frame, end
  openjd,  ///< openjd_progress and openjd_status lines on standard output, as OpenJD 2023-09 defines them
  none
};

/// --progress.
void add_progress_option(CLI::App& command, ProgressStyle& style);

/// Tells the progress of one run; one thread.
class RunProgress {
 public:
  RunProgress(ProgressStyle style, bool quiet, std::uint64_t frames);

  /// empty: its picture shows nothing.
  void done(std::uint64_t frame, const std::vector<std::string>& files, double milliseconds, bool empty = false);
  void failed(std::uint64_t frame, int exit_code, const std::string& message);
  /// Behind the last frame, whatever became of it.
  void end();

 private:
  void advance();

  ProgressStyle style_;
  std::uint64_t total_, done_ = 0, failed_ = 0;
  int last_tenth_ = -1;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace meniscus
