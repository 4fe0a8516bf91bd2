// SPDX-License-Identifier: BSD-3-Clause
// Builds the command line of each maker.
#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "app/farm/blender_driver.h"
#include "app/farm/child_process.h"
#include "app/farm/check_bundle.h"
#include "app/farm/command_options.h"
#include "app/farm/makers.h"
#include "app/farm/png_without_time.h"
#include "core/trajectory/frame_list.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"

namespace meniscus::farm {
namespace {

using Arguments = std::vector<std::string>;

// What the worker was told replaces what the bundle says. alone: one frame after another.
Arguments device_words(const Step& step, const Workplace& place, bool alone) {
  std::vector<CommandOption> options = read_device_options(step.arguments);
  std::erase_if(options, [&](const CommandOption& option) {
    if (option.name == "--jobs") return alone;
    return option.name == "--threads" ? place.threads > 0 : !place.device_options.empty();
  });
  Arguments words = as_words(options);
  words.insert(words.end(), place.device_options.begin(), place.device_options.end());
  if (place.threads > 0) words.push_back(fmt::format("--threads={}", place.threads));
  if (alone) words.emplace_back("--jobs=1");
  return words;
}

Arguments meniscus_command(const Bundle& bundle, const Step& step, const Workplace& place,
                           const std::vector<std::uint64_t>& frames, bool alone) {
  // This very program, whatever PATH says: the frames of a run must come from one version.
  Arguments command{system_file::program().string()};
  const Arguments checked = checked_command(bundle, place.folder);
  command.insert(command.end(), checked.begin(), checked.end());
  const Arguments device = device_words(step, place, alone);
  command.insert(command.end(), device.begin(), device.end());
  const bool layered = std::ranges::any_of(checked, [](const std::string& word) {
    return word == "--aovs" || word == "--cryptomatte" || word == "--color-space=acescg";
  });
  const char* const output = bundle.command.front() != "render" ? "scene"
                             : layered                          ? "images/frame_#####.exr"
                                                                : "images/frame_#####.png";
  for (const char* word : {"--force", "-q", "--progress", "json", "-o", output}) command.emplace_back(word);
  command.insert(command.end(), {"--only", frame_list_text(frames)});
  return command;
}

Arguments blender_command(const std::string& driver, const Step& step, const Workplace& place,
                          const std::vector<std::uint64_t>& frames) {
  Arguments command{"blender", "-b", "--factory-startup"};
  if (place.threads > 0) command.insert(command.end(), {"-t", std::to_string(place.threads)});
  command.insert(command.end(), {"--python-exit-code", "3", "--python", driver, "--", "scene/surface_sequence.json",
                                 "--output", "images/frame_#####.png"});
  command.insert(command.end(), {"--frames", frame_list_text(frames)});
  command.insert(command.end(), step.arguments.begin(), step.arguments.end());
  return command;
}

/// Blender writes the time into its pictures.
FrameListener without_dates(const FrameListener& listener, const std::filesystem::path& folder) {
  FrameListener result = listener;
  result.done = [=](std::uint64_t frame, const std::vector<std::string>& files, double seconds) {
    for (const std::string& file : files) remove_png_time(folder / file);
    listener.done(frame, files, seconds);
  };
  return result;
}

}  // namespace

void make_frames(const Bundle& bundle, const Step& step, const Workplace& place,
                 const std::vector<std::uint64_t>& frames, const FrameListener& listener) {
  if (step.maker == Maker::povray) return make_by_povray(bundle, step, place, frames, listener);
  make_folders_of(place.folder / "images" / "frame");
  const bool blender = step.maker == Maker::blender;
  std::optional<DriverCopy> driver;
  if (blender) {
    const StopBarrier barrier;
    driver.emplace(place.folder);
  }
  make_by_lines(
      [&](const std::vector<std::uint64_t>& left, bool alone) {
        return blender ? blender_command(driver->script(), step, place, left)
                       : meniscus_command(bundle, step, place, left, alone);
      },
      place.folder, frames, blender ? without_dates(listener, place.folder) : listener);
}

}  // namespace meniscus::farm
