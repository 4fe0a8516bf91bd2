// SPDX-License-Identifier: BSD-3-Clause
// Progress of long tasks as reports to a callback, a text display of these reports, and a clock of named stages.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

struct StageTime {
  std::string name;
  double milliseconds = 0.0;
};

/// The way in which stages account for work that another device does in parallel.
enum class StageTiming {
  rough,  ///< does not wait: work of one stage may count for a later stage that needs it; sums are right
  exact   ///< waits until the device is idle at both ends of each stage, which costs a round trip each
};

/// Adds up the times of stages by name. times() has them in the order in which they first ended.
class StageClock {
 public:
  /// A running stage. It ends when this object is destroyed.
  class Stage {
   public:
    Stage(StageClock& clock, std::string name)
        : clock_(clock), time_{std::move(name), 0.0}, begin_(std::chrono::steady_clock::now()) {
      clock_.reserve_entry();
    }
    ~Stage() {
      time_.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
      clock_.end(std::move(time_));
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

   private:
    StageClock& clock_;
    StageTime time_;
    std::chrono::steady_clock::time_point begin_;
  };

  explicit StageClock(StageTiming timing = StageTiming::rough) : is_exact_(timing == StageTiming::exact) {}

  [[nodiscard]] Stage stage(const std::string& name) {
    if (check_) check_();
    return Stage(*this, name);
  }

  /// Sets a function that is called before each stage. An exception that it throws ends the work.
  void before_stages(std::function<void()> check) { check_ = std::move(check); }

  /// Adds time that was measured elsewhere.
  void add(std::string name, double milliseconds) {
    reserve_entry();
    end({std::move(name), milliseconds});
  }

  void restart() { times_.clear(); }
  bool is_exact() const { return is_exact_; }
  const std::vector<StageTime>& times() const { return times_; }

 private:
  /// Reserves room for the time of a stage when it begins, so that the stage can end without allocating memory.
  void reserve_entry() {
    times_.reserve(times_.size() + open_ + 1);
    ++open_;
  }

  void end(StageTime time) noexcept {
    --open_;
    const auto known = std::ranges::find(times_, time.name, &StageTime::name);
    if (known == times_.end())
      times_.push_back(std::move(time));
    else
      known->milliseconds += time.milliseconds;
  }

  bool is_exact_;
  std::function<void()> check_;
  std::vector<StageTime> times_;
  std::size_t open_ = 0;
};

}  // namespace meniscus
