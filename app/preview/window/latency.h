// SPDX-License-Identifier: BSD-3-Clause
// From a movement to its picture, by the clock of the window.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus {

/// How long pictures took that followed a movement.
struct FrameLatency {
  std::size_t pictures = 0;
  double median_ms = 0.0, p95_ms = 0.0;
};

/// Seconds on any one clock.
class LatencyMeter {
 public:
  /// A command was sent, for something that happened at `time`. Only orbit, pan, zoom, probe and frame count.
  void sent(std::uint64_t number, const nlohmann::json& command, double time);
  /// A picture that shows all commands up to `number` is in the window since `time`.
  void shown(std::uint64_t number, double time);
  FrameLatency result() const;

 private:
  struct Movement {
    std::uint64_t number;
    double time;
  };
  std::deque<Movement> waiting_;
  std::vector<double> seconds_;  // one a picture: of the oldest movement in it
};

}  // namespace meniscus
