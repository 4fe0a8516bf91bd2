// SPDX-License-Identifier: BSD-3-Clause
// Renders one frame per POV-Ray process, in a folder of its own with the checked files; the picture gets its name when
// complete, without its date.
#include <algorithm>
#include <chrono>

#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/check_scene.h"
#include "app/farm/child_process.h"
#include "app/farm/error_line.h"
#include "app/farm/makers.h"
#include "app/farm/png_without_time.h"
#include "app/process/program_error.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "surface.ini";
std::string own_name(std::uint64_t frame) { return fmt::format(".povray_{}_{}", ::getpid(), frame_digits(frame)); }

std::vector<std::string> povray_command(const Step& step, const Workplace& place, std::uint64_t frame,
                                        const std::string& output) {
  std::vector<std::string> command{"povray"};
  const bool chosen = std::ranges::any_of(step.arguments, [](const auto& a) { return a.starts_with(kScene); });
  if (!chosen) command.emplace_back(kScene);
  command.insert(command.end(), step.arguments.begin(), step.arguments.end());
  if (place.threads > 0) command.push_back(fmt::format("+WT{}", place.threads));
  for (const std::string& option :
       {fmt::format("+SF{}", frame), fmt::format("+EF{}", frame), std::string("-D"), std::string("+FN"), "+O" + output})
    command.push_back(option);
  return command;
}

// The one picture in the folder: POV-Ray adds the frame to its name.
fs::path picture_in(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") return entry.path();
  return {};
}

struct Ended {
  int code = 0;
  std::string words;  ///< that tell why
};

Ended run_povray(const std::vector<std::string>& command, const fs::path& folder, const FrameListener& listener) {
  ErrorLine last;
  ChildProcess child(command, folder);
  while (const std::optional<std::string> line = child.next_line()) {
    last.add(*line);
    listener.said(*line);
  }
  const int code = child.wait();
  return {code, last.words()};
}

/// A folder for the scene and the picture of one process, away with this object.
class OwnFolder {
 public:
  // An object whose first constructor is done is destroyed when the second throws, and the folder with it.
  OwnFolder(const fs::path& path, const Workplace& place, std::uint64_t frame) : OwnFolder(path) {
    const StopBarrier barrier;
    fs::create_directories(path_);
    copy_checked_scene(place.folder, frame, path_);
  }
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

 private:
  explicit OwnFolder(const fs::path& path) : path_(path) {}

  fs::path path_;
};

void render(const Step& step, const Workplace& place, std::uint64_t frame, const std::string& picture,
            const FrameListener& listener) {
  const std::string name = own_name(frame);
  const fs::path own = place.folder / "images" / name;
  const OwnFolder folder(own, place, frame);
  // POV-Ray says where it writes: its log names the frame.
  const std::vector<std::string> command = povray_command(step, place, frame, fmt::format("../{}/frame.png", name));
  Ended ended = run_povray(command, own, listener);
  if (ended.code > kSignalCode) {
    listener.tried_again(frame, signal_text(ended.code));
    ended = run_povray(command, own, listener);
  }
  if (ended.code > kSignalCode)
    throw RunError(static_cast<ExitCode>(signal_exit_code(ended.code)), signal_text(ended.code) + ", twice");
  const fs::path made = picture_in(own);
  if (ended.code != 0 || made.empty())
    throw RunError(kExitInput, fmt::format("povray ended with code {}: {}", ended.code, ended.words));
  const StopBarrier barrier;
  remove_png_time(made);
  fs::rename(made, place.folder / picture);
}

}  // namespace

void make_by_povray(const Bundle&, const Step& step, const Workplace& place, const std::vector<std::uint64_t>& frames,
                    const FrameListener& listener) {
  check_scene(place.folder);
  for (const std::uint64_t frame : frames) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string picture = fmt::format("images/frame_{}.png", frame_digits(frame));
    try {
      render(step, place, frame, picture, listener);
    } catch (const RunError& error) {
      listener.failed(frame, error.code(), error.what());
      continue;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    listener.done(frame, {picture}, elapsed.count());
  }
}

}  // namespace meniscus::farm
