// SPDX-License-Identifier: BSD-3-Clause
// Runs a program that makes many frames and reports each as a line of JSON.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/farm/child_process.h"
#include "app/farm/error_line.h"
#include "app/farm/makers.h"
#include "app/process/program_error.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using nlohmann::json;

// A path as the bundle knows it; the program may have said it in a longer way.
std::string relative_to(const std::filesystem::path& folder, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(text).lexically_normal();
  return path.is_absolute() ? path.lexically_proximate(std::filesystem::absolute(folder)).string() : path.string();
}

/// The object of a line that a program says for this one.
std::optional<json> event_in(const std::string& line) {
  if (!line.starts_with('{')) return {};
  json event = json::parse(line, nullptr, false);
  return event.is_object() ? std::optional(std::move(event)) : std::nullopt;
}

/// Tells the listener about the frame of an event and takes it off the list.
void take_frame(const json& event, const std::filesystem::path& folder, std::vector<std::uint64_t>& frames,
                const FrameListener& listener) {
  if (!event.contains("frame") || !event.contains("state")) return;
  const auto frame = event["frame"].get<std::uint64_t>();
  if (std::erase(frames, frame) == 0) return;
  if (event["state"] == "done") {
    std::vector<std::string> files;
    for (const json& file : event.at("files")) files.push_back(relative_to(folder, file.get<std::string>()));
    listener.done(frame, files, event.value("ms", 0.0) / 1000.0);
  } else {
    listener.failed(frame, event.value("exit", static_cast<int>(kExitInternal)), event.value("error", "no reason"));
  }
}

}  // namespace

void make_by_lines(
    const std::function<std::vector<std::string>(const std::vector<std::uint64_t>& frames, bool alone)>& command_for,
    const std::filesystem::path& folder, std::vector<std::uint64_t> frames, const FrameListener& listener) {
  std::optional<std::uint64_t> tried;  // the frame that was given a second process
  while (!frames.empty()) {
    ChildProcess child(command_for(frames, tried.has_value()), folder);
    ErrorLine last;
    bool several = false;  // frames are made at once
    while (const std::optional<std::string> line = child.next_line()) {
      if (const std::optional<json> event = event_in(*line)) {
        several = several || event->value("at_once", 1) > 1;
        take_frame(*event, folder, frames, listener);
        continue;
      }
      last.add(*line);
      if (!several) listener.said(*line);
    }
    const int code = child.wait();
    if (frames.empty()) return;
    if (code <= kSignalCode) {
      // An orderly end before the last frame: the next process would end so, too.
      throw RunError(code == kExitOk ? kExitInternal : static_cast<ExitCode>(code),
                     fmt::format("frame {}{} not made: {}", frames.front(),
                                 frames.size() == 1 ? " was" : fmt::format(" and {} more were", frames.size() - 1),
                                 last.words().empty() ? fmt::format("exit code {}", code) : last.words()));
    }
    const std::uint64_t culprit = frames.front();
    if (tried != culprit) {
      tried = culprit;
      // The first of those that it made may not be the one that ended it.
      listener.tried_again(culprit, signal_text(code) + (several ? ", while it made several frames at once" : ""));
      continue;
    }
    frames.erase(frames.begin());
    listener.failed(culprit, signal_exit_code(code), signal_text(code) + ", twice");
  }
}

}  // namespace meniscus::farm
