// SPDX-License-Identifier: BSD-3-Clause
// Counts records with their files, and estimates the time left from what running workers have made so far.
#include "app/farm/status.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "app/farm/pause.h"
#include "app/farm/sign_of_life.h"

namespace meniscus::farm {
namespace {

/// What one worker has made of a step, by its own clock in seconds.
struct Made {
  std::uint64_t frames = 0;
  double begin = std::numeric_limits<double>::infinity(), end = -std::numeric_limits<double>::infinity();

  void add(const FrameRecord& record) {
    ++frames;
    begin = std::min(begin, record.ended - record.seconds);
    end = std::max(end, record.ended);
  }
  /// Frames a second; nothing if it has made none in any time.
  std::optional<double> pace() const {
    return frames > 0 && end > begin ? std::optional(static_cast<double>(frames) / (end - begin)) : std::nullopt;
  }
};

using MadeBy = std::map<std::string, Made>;

/// Frames a second of these workers together. One that has made none yet counts like the mean of the others, or, where
/// none has, like the mean of all frames done.
std::optional<double> common_pace(const std::vector<std::string>& workers, const MadeBy& made,
                                  const std::optional<double>& seconds_per_frame) {
  double sum = 0.0;
  std::size_t known = 0;
  for (const std::string& worker : workers) {
    const auto found = made.find(worker);
    const std::optional<double> pace = found == made.end() ? std::nullopt : found->second.pace();
    if (!pace) continue;
    sum += *pace;
    ++known;
  }
  const auto count = static_cast<double>(workers.size());
  if (known > 0) return sum * count / static_cast<double>(known);
  if (workers.empty() || !seconds_per_frame || *seconds_per_frame <= 0.0) return {};
  return count / *seconds_per_frame;
}

StepStatus status_of(const Step& step, const Bundle& bundle, const FrameRecords& records,
                     const std::vector<std::string>& workers) {
  StepStatus status;
  status.step = step.name;
  double seconds = 0.0;
  MadeBy made;
  for (const std::uint64_t frame : bundle.frames) {
    std::optional<FrameRecord> record = records.read(step.name, frame);
    if (!record) {
      ++status.missing;
    } else if (!record->done()) {
      status.failed.push_back(std::move(*record));
    } else if (std::string fault = records.fault(*record, Look::sizes); !fault.empty()) {
      status.damaged.push_back({frame, std::move(fault)});
    } else {
      ++status.done;
      seconds += record->seconds;
      made[record->worker].add(*record);
    }
  }
  if (status.done > 0) status.seconds_per_frame = seconds / static_cast<double>(status.done);
  const auto left = static_cast<double>(status.left());
  if (status.left() == 0) {
    status.seconds_left = status.seconds_to_go = 0.0;
    return status;
  }
  if (status.seconds_per_frame) status.seconds_left = *status.seconds_per_frame * left;
  if (const std::optional<double> pace = common_pace(workers, made, status.seconds_per_frame))
    status.seconds_to_go = left / *pace;
  return status;
}

}  // namespace

BundleStatus status_of(const Bundle& bundle, const std::filesystem::path& folder) {
  const FrameRecords records(folder, bundle);
  BundleStatus status;
  status.workers = live_workers(folder, [&] { return file_system_now(folder); });
  status.paused = is_paused(folder);
  if (bundle.film) status.film = read_film_note(bundle, folder);
  status.seconds_to_go = 0.0;
  for (const Step& step : bundle.steps) {
    status.steps.push_back(status_of(step, bundle, records, status.workers));
    const std::optional<double> more = status.steps.back().seconds_to_go;
    status.seconds_to_go = more && status.seconds_to_go ? std::optional(*status.seconds_to_go + *more) : std::nullopt;
  }
  return status;
}

}  // namespace meniscus::farm
