// SPDX-License-Identifier: BSD-3-Clause
// Runs this program, POV-Ray and Blender. Pictures of others appear in a hidden folder of the worker's own, and get
// their names when they are whole and without dates.
#include "app/farm/make_frames.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

constexpr const char* kOwnFolder = ".work_";

/// A hidden folder in the bundle for the files of one renderer, away with this object and when the program is stopped.
/// A temporary folder of one worker. Its name is unique on all machines.
class OwnFolder {
 public:
  explicit OwnFolder(const fs::path& bundle) : path_(bundle / fmt::format("{}XXXXXX", kOwnFolder)) {
    std::string name = path_.string();
    if (!::mkdtemp(name.data())) throw OutputError(bundle.string(), std::strerror(errno));
    path_ = name;
  }
  ~OwnFolder() { remove(); }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  const fs::path& path() const { return path_; }
  std::string name() const { return path_.filename().string(); }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path path_;
  StopHandler stop_{[this] {
                      stop_children();
                      remove();
                    },
                    std::nullopt};
};

/// Finds why a program failed: its first line about an error, else its last line with text.
class Reason {
 public:
  void add(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" =-\t\r");
    if (begin == std::string::npos || names_error_) return;
    names_error_ = line.find("rror") != std::string::npos;
    words_ = line.substr(begin);
    // The reason is printed after this program's own prefix, which appears once.
    constexpr std::string_view kOurs = "meniscus: error: ";
    if (words_.starts_with(kOurs)) words_.erase(0, kOurs.size());
  }
  const std::string& words() const { return words_; }

 private:
  std::string words_;
  bool names_error_ = false;
};

/// Returns the device options of the bundle, then those of the worker, which override them.
Words device_words(const Bundle& bundle, const Workplace& place, bool alone) {
  Words words = bundle.device;
  if (!place.device.empty()) std::erase(words, "--require-gpu");
  words.insert(words.end(), place.device.begin(), place.device.end());
  if (place.threads > 0) words.insert(words.end(), {"--threads", std::to_string(place.threads)});
  if (alone) words.insert(words.end(), {"--jobs", "1"});
  return words;
}

Words meniscus_command(const Bundle& bundle, Step step, const Workplace& place,
                       const std::vector<std::uint64_t>& frames, bool alone) {
  // This very program, whatever PATH says: the frames of a run must come from one version.
  Words words{system_file::program_path().string()};
  words.insert(words.end(), bundle.command.begin(), bundle.command.end());
  const Words device = device_words(bundle, place, alone);
  words.insert(words.end(), device.begin(), device.end());
  const std::string output = step == Step::render ? bundle.result_pattern(step) : "scene";
  for (const std::string& word :
       {std::string("--force"), std::string("-q"), std::string("--progress"), std::string("json"), std::string("-o"),
        output, std::string("--only"), frame_list_text(frames)})
    words.push_back(word);
  return words;
}

Words blender_command(const Bundle& bundle, const Workplace& place, const std::string& pictures,
                      const std::vector<std::uint64_t>& frames) {
  Words words{"blender", "-b", "--factory-startup"};
  if (place.threads > 0) words.insert(words.end(), {"-t", std::to_string(place.threads)});
  words.insert(words.end(), {"--python-exit-code", "3", "--python-expr", "import sys; sys.dont_write_bytecode = True",
                             "--python", "inputs/blender/render_mns.py", "--", "scene/surface_sequence.json",
                             "--output", pictures, "--frames", frame_list_text(frames)});
  words.insert(words.end(), bundle.renderer.begin(), bundle.renderer.end());
  return words;
}

Words povray_command(const Bundle& bundle, const Workplace& place, std::uint64_t frame, const std::string& picture) {
  constexpr const char* kScene = "surface.ini";
  Words words{"povray"};
  const auto is_scene = [](const std::string& word) { return word.starts_with(kScene); };
  if (std::ranges::none_of(bundle.renderer, is_scene)) words.emplace_back(kScene);
  words.insert(words.end(), bundle.renderer.begin(), bundle.renderer.end());
  if (place.threads > 0) words.push_back(fmt::format("+WT{}", place.threads));
  for (const std::string& word : {fmt::format("+SF{}", frame), fmt::format("+EF{}", frame), std::string("-D"),
                                  std::string("+FN"), "+O" + picture})
    words.push_back(word);
  return words;
}

/// Gives a whole picture its name, and takes the file away.
void take_picture(const fs::path& from, const fs::path& to) {
  const StopBarrier barrier;
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  OutputFile file(to, Existing::replace);
  file.write(png_without_time(bytes));
  file.commit();
  fs::remove(from);
}

/// Makes one picture in a folder that holds nothing else.
void render_by_povray(const Bundle& bundle, const Workplace& place, std::uint64_t frame, const OwnFolder& own) {
  Reason reason;
  int code = kSignalCode + 1;
  for (int tries = 0; tries < 2 && code > kSignalCode; ++tries) {
    ChildProcess child(povray_command(bundle, place, frame, fmt::format("../{}/frame.png", own.name())),
                       place.folder / "scene");
    while (const std::optional<std::string> line = child.next_line()) reason.add(*line);
    code = child.wait();
  }
  if (code > kSignalCode) throw RunError(static_cast<ExitCode>(signal_exit_code(code)), signal_text(code) + ", twice");
  // POV-Ray adds the number of the frame to the name.
  const auto picture = fs::directory_iterator(own.path());
  if (code != 0 || picture == fs::directory_iterator())
    throw RunError(kExitInput, fmt::format("povray ended with code {}: {}", code, reason.words()));
  take_picture(picture->path(), place.folder / numbered(bundle.result_pattern(Step::render), frame));
}

void make_by_povray(const Bundle& bundle, const Workplace& place, const std::vector<std::uint64_t>& frames,
                    const FrameListener& listener) {
  for (const std::uint64_t frame : frames) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      render_by_povray(bundle, place, frame, OwnFolder(place.folder));
    } catch (const RunError& error) {
      listener.failed(frame, error.code(), error.what());
      continue;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    listener.done(frame, {numbered(bundle.result_pattern(Step::render), frame)}, elapsed.count());
  }
}

void make_by_blender(const Bundle& bundle, const Workplace& place, const std::vector<std::uint64_t>& frames,
                     const FrameListener& listener) {
  const OwnFolder own(place.folder);
  const std::string made = own.name() + "/frame_#####.png";
  FrameListener hearing = listener;
  hearing.done = [&](std::uint64_t frame, const std::vector<std::string>&, double seconds) {
    const std::string picture = numbered(bundle.result_pattern(Step::render), frame);
    take_picture(place.folder / numbered(made, frame), place.folder / picture);
    listener.done(frame, {picture}, seconds);
  };
  make_by_lines(
      [&](const std::vector<std::uint64_t>& left, bool) { return blender_command(bundle, place, made, left); },
      place.folder, frames, hearing);
}

/// Tells the listener of the frame in a line that a program says for this one, and takes it off the list.
bool take_line(const std::string& line, std::vector<std::uint64_t>& frames, const FrameListener& listener) {
  if (!line.starts_with('{')) return false;
  const json event = json::parse(line, nullptr, false);
  if (!event.is_object()) return false;
  if (!event.contains("frame") || !event.contains("state")) return true;
  const auto frame = event["frame"].get<std::uint64_t>();
  if (std::erase(frames, frame) == 0) return true;
  if (event["state"] == "done")
    listener.done(frame, event.value("files", std::vector<std::string>()), event.value("ms", 0.0) / 1000.0);
  else
    listener.failed(frame, event.value("exit", static_cast<int>(kExitInternal)), event.value("error", "no reason"));
  return true;
}

}  // namespace

void make_by_lines(
    const std::function<std::vector<std::string>(const std::vector<std::uint64_t>& frames, bool alone)>& command_for,
    const fs::path& folder, std::vector<std::uint64_t> frames, const FrameListener& listener) {
  std::optional<std::uint64_t> tried;  // the frame that was given a second process
  while (!frames.empty()) {
    ChildProcess child(command_for(frames, tried.has_value()), folder);
    Reason reason;
    while (const std::optional<std::string> line = child.next_line())
      if (!take_line(*line, frames, listener)) reason.add(*line);
    const int code = child.wait();
    if (frames.empty()) return;
    const std::uint64_t culprit = frames.front();
    if (code <= kSignalCode) {
      // An orderly end before the last frame: the next process would end so, too.
      throw RunError(code == kExitOk ? kExitInternal : static_cast<ExitCode>(code),
                     fmt::format("frame {}{} not made: {}", culprit,
                                 frames.size() == 1 ? " was" : fmt::format(" and {} more were", frames.size() - 1),
                                 reason.words().empty() ? fmt::format("exit code {}", code) : reason.words()));
    }
    if (tried == culprit) {
      frames.erase(frames.begin());
      listener.failed(culprit, signal_exit_code(code), signal_text(code) + ", twice");
    }
    tried = culprit;
  }
}

void make_frames(const Bundle& bundle, Step step, const Workplace& place, const std::vector<std::uint64_t>& frames,
                 const FrameListener& listener) {
  make_folders_of(place.folder / bundle.result_pattern(step));
  const Maker maker = bundle.maker(step);
  if (maker == Maker::povray) return make_by_povray(bundle, place, frames, listener);
  if (maker == Maker::blender) return make_by_blender(bundle, place, frames, listener);
  make_by_lines([&](const std::vector<std::uint64_t>& left,
                    bool alone) { return meniscus_command(bundle, step, place, left, alone); },
                place.folder, frames, listener);
}

std::string png_without_time(std::string_view file) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::array<std::string_view, 4> kDropped{"tIME", "tEXt", "zTXt", "iTXt"};
  constexpr std::size_t kAround = 12;  // bytes of a chunk beside its data: length, type, CRC
  if (!file.starts_with(kSignature)) throw RunError(kExitInput, "the picture is not a PNG file");
  std::string result(kSignature);
  file.remove_prefix(kSignature.size());
  for (std::string_view type; type != "IEND";) {
    std::size_t size = 0;  // of the data
    for (const char byte : file.substr(0, 4)) size = size << 8 | static_cast<std::uint8_t>(byte);
    if (file.size() < kAround + size) throw RunError(kExitInput, "the picture ends in the middle");
    type = file.substr(4, 4);
    if (std::ranges::find(kDropped, type) == kDropped.end()) result.append(file.substr(0, kAround + size));
    file.remove_prefix(kAround + size);
  }
  return result;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const char* place : {".", "images", "scene"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / place, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(kOwnFolder) || (name.starts_with('.') && name.find(".part") != std::string::npos))
        found.push_back(entry.path());
    }
  }
  for (const fs::path& path : found) fs::remove_all(path, error);
}

}  // namespace meniscus::farm
