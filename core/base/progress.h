// SPDX-License-Identifier: BSD-3-Clause
// Progress of long tasks: the library reports to a callback, and ProgressText turns reports into a bar or plain lines.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace meniscus {

/// A report that `done` of `total` units of a task are finished, with total > 0 and done <= total. The last report of a
/// task has done == total.
struct ProgressReport {
  std::string_view task;
  std::uint64_t done = 0;
  std::uint64_t total = 1;
};

/// A function that receives reports. An empty one is allowed and receives none.
using ProgressSink = std::function<void(const ProgressReport&)>;

/// Counts the finished units of one task. Any thread may call advance(). The sink is called by one thread at a time, at
/// most about 20 times a second, and always at the end.
class Progress {
 public:
  /// Reports the beginning of the task.
  Progress(ProgressSink sink, std::string task, std::uint64_t total);
  /// Counts finished units, and reports if the last report is old enough.
  void advance(std::uint64_t units = 1);

 private:
  ProgressSink sink_;
  std::string task_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_report_;
};

/// Writes reports as text. A terminal gets one bar that is redrawn. A log gets a line at the start of each task and at
/// every further tenth of it, so that it stays short. `write` receives complete text with its line ends.
class ProgressText {
 public:
  ProgressText(bool terminal, std::function<void(std::string_view)> write);
  void report(const ProgressReport& report);

 private:
  bool is_terminal_;
  std::function<void(std::string_view)> write_;
  std::string task_;
  int last_tenth_ = -1;
};

}  // namespace meniscus
