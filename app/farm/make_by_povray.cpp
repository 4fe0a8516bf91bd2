// SPDX-License-Identifier: BSD-3-Clause
// POV-Ray renders one frame of the scene a process, into a folder of its own; the picture gets its name when whole,
// without its date.
#include <algorithm>
#include <chrono>

#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/child_process.h"
#include "app/farm/last_words.h"
#include "app/farm/makers.h"
#include "app/farm/timeless_png.h"
#include "app/program_error.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "surface.ini";
constexpr std::string_view kPrefix = ".povray_";

std::string own_prefix() { return fmt::format("{}{}_", kPrefix, ::getpid()); }

std::vector<std::string> povray_command(const Step& step, const Workplace& place, std::size_t scene_frame,
                                        const std::string& output) {
  std::vector<std::string> command{"povray"};
  const bool chosen = std::ranges::any_of(step.arguments, [](const auto& a) { return a.starts_with(kScene); });
  if (!chosen) command.emplace_back(kScene);
  command.insert(command.end(), step.arguments.begin(), step.arguments.end());
  if (place.threads > 0) command.push_back(fmt::format("+WT{}", place.threads));
  for (const std::string& option : {fmt::format("+SF{}", scene_frame), fmt::format("+EF{}", scene_frame),
                                    std::string("-D"), std::string("+FN"), "+O" + output})
    command.push_back(option);
  return command;
}

// The one picture in the folder: POV-Ray adds the scene frame to its name.
fs::path picture_in(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") return entry.path();
  return {};
}

template <typename Condition>
void remove_from(const fs::path& folder, const Condition& unwanted) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (unwanted(entry.path().filename().string())) found.push_back(entry.path());
  for (const fs::path& path : found) fs::remove_all(path, error);
}

void render(const Bundle& bundle, const Step& step, const Workplace& place, std::uint64_t frame,
            const std::string& picture) {
  const fs::path images = place.folder / "images";
  const std::string name = own_prefix() + frame_digits(frame);
  const fs::path own = images / name;
  fs::create_directories(own);
  LastWords last;
  ChildProcess child(
      povray_command(step, place, bundle.place_of(frame) + 1, fmt::format("../images/{}/frame.png", name)),
      place.folder / "scene");
  while (const std::optional<std::string> line = child.next_line()) last.hear(*line);
  const int code = child.wait();
  const fs::path made = picture_in(own);
  if (code != 0 || made.empty()) {
    fs::remove_all(own);
    throw RunError(kExitInput, fmt::format("povray ended with code {}: {}", code, last.words()));
  }
  make_timeless(made);
  fs::rename(made, place.folder / picture);
  fs::remove_all(own);
}

}  // namespace

void make_by_povray(const Bundle& bundle, const Step& step, const Workplace& place,
                    const std::vector<std::uint64_t>& frames, const FrameListener& listener) {
  for (const std::uint64_t frame : frames) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string picture = fmt::format("images/frame_{}.png", frame_digits(frame));
    try {
      render(bundle, step, place, frame, picture);
    } catch (const RunError& error) {
      listener.failed(frame, error.code(), error.what());
      continue;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    listener.done(frame, {picture}, elapsed.count());
  }
}

void remove_own_pictures(const fs::path& folder) {
  remove_from(folder / "images", [](const std::string& name) { return name.starts_with(own_prefix()); });
}

void remove_leftovers(const fs::path& folder) {
  const auto unfinished = [](const std::string& name) {
    return name.starts_with(kPrefix) || (name.starts_with('.') && name.find(".part") != std::string::npos);
  };
  for (const char* place : {".", "images", "scene", "state/surface", "state/render"})
    remove_from(folder / place, unfinished);
}

}  // namespace meniscus::farm
