// SPDX-License-Identifier: BSD-3-Clause
// How long each named stage of some work takes by the clock on the wall.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Name and duration of one stage.
struct StageTime {
  std::string name;
  double milliseconds = 0.0;
};

/// Adds up the times of stages by name, in order of first appearance.
class StageClock {
 public:
  /// A stage lasts as long as the returned object.
  class Stage {
   public:
    Stage(StageClock& clock, std::string name)
        : clock_(clock), name_(std::move(name)), begin_(std::chrono::steady_clock::now()) {}
    ~Stage() {
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin_;
      clock_.add(name_, elapsed.count());
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

   private:
    StageClock& clock_;
    std::string name_;
    std::chrono::steady_clock::time_point begin_;
  };

  [[nodiscard]] Stage stage(const std::string& name) { return Stage(*this, name); }

  void add(const std::string& name, double milliseconds) {
    auto known = std::find_if(times_.begin(), times_.end(), [&](const StageTime& t) { return t.name == name; });
    if (known == times_.end()) known = times_.insert(times_.end(), {name, 0.0});
    known->milliseconds += milliseconds;
  }

  void restart() { times_.clear(); }
  const std::vector<StageTime>& times() const { return times_; }

 private:
  std::vector<StageTime> times_;
};

}  // namespace meniscus
