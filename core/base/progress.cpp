// SPDX-License-Identifier: BSD-3-Clause
// Counts progress at a limited rate of reports, and shows it as a bar or as plain lines.
#include "core/base/progress.h"

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr auto kReportInterval = std::chrono::milliseconds(50);
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(ProgressSink sink, std::string task, std::uint64_t total)
    : sink_(std::move(sink)), task_(std::move(task)), total_(std::max<std::uint64_t>(total, 1)) {
  if (sink_) sink_({task_, 0, total_});
  last_report_ = std::chrono::steady_clock::now();
}

void Progress::advance(std::uint64_t units) {
  const std::uint64_t done = done_.fetch_add(units) + units;
  if (!sink_) return;
  const bool last = done >= total_;
  std::unique_lock lock(mutex_, std::defer_lock);
  if (last) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;  // another thread is reporting now, so that this report would follow too soon
  }
  const auto now = std::chrono::steady_clock::now();
  if (!last && now - last_report_ < kReportInterval) return;
  last_report_ = now;
  sink_({task_, std::min(done, total_), total_});
}

ProgressText::ProgressText(bool terminal, std::function<void(std::string_view)> write)
    : is_terminal_(terminal), write_(std::move(write)) {}

void ProgressText::report(const ProgressReport& report) {
  const double share = static_cast<double>(report.done) / static_cast<double>(report.total);
  const int percent = static_cast<int>(100.0 * share);
  if (report.task != task_) {
    task_ = report.task;
    last_tenth_ = -1;
  }
  if (is_terminal_) {
    const int filled = static_cast<int>(kBarWidth * share);
    write_(fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {:3d} %{}", task_, "", filled, "", kBarWidth - filled, percent,
                       report.done == report.total ? "\n" : ""));
    return;
  }
  const int tenth = percent / 10;
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  write_(fmt::format("{}: {} of {} ({} %)\n", task_, report.done, report.total, percent));
}

}  // namespace meniscus
