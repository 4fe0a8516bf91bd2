// SPDX-License-Identifier: BSD-3-Clause
// Counts records with their files, and writes the counts.
#include "app/farm/status.h"

#include <algorithm>
#include <iterator>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kFaultsShown = 5;  // of a step and kind, the last ones

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  return whole < 3600 ? fmt::format("{}:{:02} min", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

template <typename Frame>
std::span<const Frame> last(const std::vector<Frame>& frames) {
  return std::span(frames).last(std::min(frames.size(), kFaultsShown));
}

StepStatus status_of(const Step& step, const Bundle& bundle, const FrameRecords& records) {
  StepStatus status;
  status.step = step.name;
  double seconds = 0.0;
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
    }
  }
  if (status.done > 0) status.seconds_per_frame = seconds / static_cast<double>(status.done);
  const std::size_t left = status.missing + status.failed.size() + status.damaged.size();
  if (left == 0) {
    status.seconds_left = 0.0;
  } else if (status.seconds_per_frame) {
    status.seconds_left = *status.seconds_per_frame * static_cast<double>(left);
  }
  return status;
}

}  // namespace

std::vector<StepStatus> status_of(const Bundle& bundle, const std::filesystem::path& folder) {
  const FrameRecords records(folder, bundle);
  std::vector<StepStatus> steps;
  for (const Step& step : bundle.steps) steps.push_back(status_of(step, bundle, records));
  return steps;
}

std::string status_table(const Bundle& bundle, const std::vector<StepStatus>& steps) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} frames, {}; {} {} a step\n\n{:<10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>12}\n",
                 with_thousands(bundle.frames.size()), frame_list_text(bundle.frames), bundle.chunking.count,
                 bundle.chunking.count == 1 ? "task" : "tasks", "step", "done", "failed", "damaged", "missing",
                 "s a frame", "left, alone");
  for (const StepStatus& step : steps) {
    fmt::format_to(out, "{:<10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>12}\n", step.step, with_thousands(step.done),
                   with_thousands(step.failed.size()), with_thousands(step.damaged.size()),
                   with_thousands(step.missing),
                   step.seconds_per_frame ? fmt::format("{:.2f}", *step.seconds_per_frame) : "?",
                   step.seconds_left ? duration(*step.seconds_left) : "?");
  }
  for (const StepStatus& step : steps) {
    for (const FrameRecord& frame : last(step.failed))
      fmt::format_to(out, "\n{} frame {}, exit code {}: {}", step.step, frame.frame, frame.exit_code,
                     escaped(frame.error));
    for (const DamagedFrame& frame : last(step.damaged))
      fmt::format_to(out, "\n{} frame {}: {}", step.step, frame.frame, escaped(frame.what));
    if (!step.failed.empty() || !step.damaged.empty()) text += "\n";
  }
  return text;
}

std::string status_json(const Bundle& bundle, const std::vector<StepStatus>& steps) {
  Json json;
  json["schema_version"] = 1;
  json["frames"] = bundle.frames.size();
  json["tasks"] = bundle.chunking.count;
  json["steps"] = Json::array();
  for (const StepStatus& step : steps) {
    Json failed = Json::array();
    for (const FrameRecord& record : step.failed)
      failed.push_back({{"frame", record.frame}, {"exit", record.exit_code}, {"error", record.error}});
    Json damaged = Json::array();
    for (const DamagedFrame& frame : step.damaged) damaged.push_back({{"frame", frame.frame}, {"what", frame.what}});
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
    json["steps"].push_back({{"name", step.step},
                             {"done", step.done},
                             {"missing", step.missing},
                             {"failed", failed},
                             {"damaged", damaged},
                             {"seconds_per_frame", number(step.seconds_per_frame)},
                             {"seconds_left", number(step.seconds_left)}});
  }
  return json.dump(2, ' ', true) + "\n";
}

}  // namespace meniscus::farm
