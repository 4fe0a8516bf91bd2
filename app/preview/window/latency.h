// SPDX-License-Identifier: BSD-3-Clause
// Measures the time from a movement to its picture, by the clock of the window.
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
  std::size_t redraws = 0;  ///< of the window, for whatever reason, while a movement waited for its picture
  double seconds = 0.0;     ///< for so long one did
};

/// Seconds on any one clock.
class LatencyMeter {
 public:
  /// A command was sent, for something that happened at `time`. Only orbit, pan, zoom, probe and frame count.
  void sent(std::uint64_t number, const nlohmann::json& command, double time);
  /// The window was redrawn, and since `time` its picture shows all commands up to `number`.
  void shown(std::uint64_t number, double time);
  FrameLatency result() const;

 private:
  struct Movement {
    std::uint64_t number;
    double time;
  };
  std::deque<Movement> waiting_;
  std::vector<double> seconds_;  // one a picture: of the oldest movement in it
  std::size_t redraws_ = 0;
  double waited_ = 0.0;   // all in all
  double counted_ = 0.0;  // until when that is in waited_
};

}  // namespace meniscus
