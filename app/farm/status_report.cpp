// SPDX-License-Identifier: BSD-3-Clause
// Writes the counts of a bundle.
#include "app/farm/status_report.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kFaultsShown = 5;   // of a step and kind, the last ones
constexpr std::size_t kWorkersShown = 4;  // by name

std::string duration(const std::optional<double>& seconds) {
  if (!seconds) return "?";
  const auto whole = static_cast<std::int64_t>(*seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  return whole < 3600 ? fmt::format("{}:{:02} min", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

template <typename Frame>
std::span<const Frame> last(const std::vector<Frame>& frames) {
  return std::span(frames).last(std::min(frames.size(), kFaultsShown));
}

/// Of a frame that failed: ", 2 tries, the next in 5 s", by this machine's clock. Nothing if it failed for good at
/// once.
std::string tries_text(const FrameRecord& failed) {
  const std::string tries = failed.tries > 1 || failed.again
                                ? fmt::format(", {} {}", failed.tries, failed.tries == 1 ? "try" : "tries")
                                : std::string();
  if (!failed.again) return tries;
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return tries + fmt::format(", the next in {}", duration(std::max(0.0, failed.ended + *failed.again - now)));
}

/// "2 workers are running (a-1-2, b-3-4): about 5:00 min to go"
std::string workers_line(const BundleStatus& status, const std::filesystem::path& folder) {
  if (status.paused)
    return fmt::format("\npaused, {} {} {}; to go on: meniscus farm resume {}\n", status.workers.size(),
                       status.workers.size() == 1 ? "worker" : "workers", status.workers.size() == 1 ? "waits" : "wait",
                       escaped(shell_word(folder.string())));
  if (status.seconds_to_go == 0.0) return {};
  if (status.workers.empty()) return "\nno worker is running\n";
  const std::size_t shown = std::min(status.workers.size(), kWorkersShown);
  return fmt::format("\n{} {} ({}{}): about {} to go\n", status.workers.size(),
                     status.workers.size() == 1 ? "worker is running" : "workers are running",
                     fmt::join(std::span(status.workers).first(shown), ", "),
                     shown < status.workers.size() ? ", ..." : "", duration(status.seconds_to_go));
}

/// The value of a label, between its quotes.
std::string label_text(const std::string& text) {
  std::string quoted;
  for (const char c : escaped(text)) {
    if (c == '\\' || c == '"') quoted += '\\';
    quoted += c;
  }
  return quoted;
}

/// One gauge with its values.
class Gauge {
 public:
  Gauge(std::string& text, std::string bundle, std::string name, const char* help)
      : text_(text), bundle_(std::move(bundle)), name_("meniscus_farm_" + std::move(name)) {
    fmt::format_to(std::back_inserter(text_), "# HELP {} {}\n# TYPE {} gauge\n", name_, help, name_);
  }
  /// What is not known has no value. labels: ",step=\"render\"".
  void add(const std::optional<double>& value, const std::string& labels = {}) const {
    if (value) fmt::format_to(std::back_inserter(text_), "{}{{bundle=\"{}\"{}}} {}\n", name_, bundle_, labels, *value);
  }

 private:
  std::string& text_;
  std::string bundle_, name_;
};

std::string of_step(const StepStatus& step) { return fmt::format(",step=\"{}\"", step.step); }

}  // namespace

std::string status_table(const Bundle& bundle, const BundleStatus& status, const std::filesystem::path& folder) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} frames, {}; {} {} a step\n\n{:<10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>12} {:>12}\n",
                 with_thousands(bundle.frames.size()), frame_list_text(bundle.frames), bundle.chunking.count,
                 bundle.chunking.count == 1 ? "task" : "tasks", "step", "done", "failed", "damaged", "missing",
                 "s a frame", "left, alone", "to go");
  for (const StepStatus& step : status.steps) {
    fmt::format_to(out, "{:<10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>12} {:>12}\n", step.step, with_thousands(step.done),
                   with_thousands(step.failed.size()), with_thousands(step.damaged.size()),
                   with_thousands(step.missing),
                   step.seconds_per_frame ? fmt::format("{:.2f}", *step.seconds_per_frame) : "?",
                   duration(step.seconds_left), duration(step.seconds_to_go));
  }
  text += workers_line(status, folder);
  std::optional<std::uint64_t> failed;
  for (const StepStatus& step : status.steps) {
    for (const FrameRecord& frame : last(step.failed))
      fmt::format_to(out, "\n{} frame {}, exit code {}{}: {}", step.step, frame.frame, frame.exit_code,
                     tries_text(frame), escaped(frame.error));
    for (const DamagedFrame& frame : last(step.damaged))
      fmt::format_to(out, "\n{} frame {}: {}", step.step, frame.frame, escaped(frame.what));
    if (!step.failed.empty() || !step.damaged.empty()) text += "\n";
    if (!step.failed.empty()) failed = step.failed.back().frame;
  }
  if (status.film)
    fmt::format_to(out, "\n{} was made without {} {}, {}: {}\n", bundle.film->file,
                   with_thousands(status.film->missing.size()), status.film->missing.size() == 1 ? "frame" : "frames",
                   frame_list_text(status.film->missing), status.film->sentence());
  if (failed) fmt::format_to(out, "\nmore: meniscus farm log {} {}\n", escaped(shell_word(folder.string())), *failed);
  return text;
}

std::string status_json(const Bundle& bundle, const BundleStatus& status) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  Json json;
  json["schema_version"] = 1;
  json["frames"] = bundle.frames.size();
  json["tasks"] = bundle.chunking.count;
  json["paused"] = status.paused;
  json["workers"] = status.workers;
  json["seconds_to_go"] = number(status.seconds_to_go);
  if (status.film)
    json["film_without"] = {{"in_place", word_of(status.film->in_place)}, {"frames", status.film->missing}};
  json["steps"] = Json::array();
  for (const StepStatus& step : status.steps) {
    Json failed = Json::array();
    for (const FrameRecord& record : step.failed)
      failed.push_back({{"frame", record.frame},
                        {"exit", record.exit_code},
                        {"error", record.error},
                        {"tries", record.tries},
                        {"again_after_seconds", number(record.again)}});
    Json damaged = Json::array();
    for (const DamagedFrame& frame : step.damaged) damaged.push_back({{"frame", frame.frame}, {"what", frame.what}});
    json["steps"].push_back({{"name", step.step},
                             {"done", step.done},
                             {"missing", step.missing},
                             {"failed", failed},
                             {"damaged", damaged},
                             {"seconds_per_frame", number(step.seconds_per_frame)},
                             {"seconds_left", number(step.seconds_left)},
                             {"seconds_to_go", number(step.seconds_to_go)}});
  }
  return json.dump(2, ' ', true) + "\n";
}

std::string status_metrics(const Bundle& bundle, const BundleStatus& status, const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  const std::string name = label_text((whole.has_filename() ? whole : whole.parent_path()).filename().string());
  std::string text;
  const Gauge frames(text, name, "frames", "Frames of a step by their state.");
  for (const StepStatus& step : status.steps) {
    const std::array<std::pair<const char*, std::size_t>, 4> counts{{{"done", step.done},
                                                                     {"failed", step.failed.size()},
                                                                     {"damaged", step.damaged.size()},
                                                                     {"missing", step.missing}}};
    for (const auto& [state, count] : counts)
      frames.add(static_cast<double>(count), of_step(step) + fmt::format(",state=\"{}\"", state));
  }
  const Gauge pace(text, name, "frame_seconds", "Mean time of a frame of a step.");
  for (const StepStatus& step : status.steps) pace.add(step.seconds_per_frame, of_step(step));
  const Gauge alone(text, name, "alone_seconds", "Time that one worker needs for the frames left of a step.");
  for (const StepStatus& step : status.steps) alone.add(step.seconds_left, of_step(step));
  const Gauge step_to_go(text, name, "step_to_go_seconds", "Time that the running workers need for a step.");
  for (const StepStatus& step : status.steps) step_to_go.add(step.seconds_to_go, of_step(step));
  Gauge(text, name, "to_go_seconds", "Time that the running workers need for all steps.").add(status.seconds_to_go);
  Gauge(text, name, "workers", "Workers that are running.").add(static_cast<double>(status.workers.size()));
  Gauge(text, name, "tasks", "Tasks of each step.").add(static_cast<double>(bundle.chunking.count));
  return text;
}

}  // namespace meniscus::farm
