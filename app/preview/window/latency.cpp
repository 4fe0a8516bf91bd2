// SPDX-License-Identifier: BSD-3-Clause
// Computes order statistics of waiting times.
#include "app/preview/window/latency.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "app/preview/command_json.h"

namespace meniscus {
namespace {

/// The smallest value that at least this share of all do not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

void LatencyMeter::sent(std::uint64_t number, const nlohmann::json& command, double time) {
  const std::string word = command_word(command);
  for (const char* movement : {"orbit", "pan", "zoom", "probe", "frame", "next_frame"}) {
    if (word != movement) continue;
    if (waiting_.empty()) counted_ = time;
    waiting_.push_back({number, time});
  }
}

void LatencyMeter::shown(std::uint64_t number, double time) {
  if (!waiting_.empty()) {
    ++redraws_;
    waited_ += time - counted_;
    counted_ = time;
  }
  std::optional<double> oldest;
  while (!waiting_.empty() && waiting_.front().number <= number) {
    if (!oldest) oldest = waiting_.front().time;
    waiting_.pop_front();
  }
  if (oldest) seconds_.push_back(time - *oldest);
}

FrameLatency LatencyMeter::result() const {
  if (seconds_.empty()) return {};
  std::vector<double> sorted = seconds_;
  std::ranges::sort(sorted);
  return {sorted.size(), 1e3 * quantile(sorted, 0.5), 1e3 * quantile(sorted, 0.95), redraws_, waited_};
}

}  // namespace meniscus
