// SPDX-License-Identifier: BSD-3-Clause
// Finds missing frames, and runs this program, POV-Ray and Blender to make them. A renderer's picture appears in a
// hidden folder of the worker, and gets its name when it is complete and without dates.
#include "app/farm/worker.h"

#include <fstream>
#include <iterator>
#include <random>

#include "app/farm/bundle_folder.h"
#include "app/process/child_process.h"
#include "app/process/program_main.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/image/png_file.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;
using Frames = std::vector<std::uint64_t>;

// A process starts slowly, so it makes so many frames that its start takes a twentieth of its time.
constexpr double kStartShare = 1.0 / 20.0;
// A process never makes more than this part of the missing frames, so that workers finish together (guided
// self-scheduling: Polychronopoulos & Kuck, IEEE Trans. Comput. 1987).
constexpr std::size_t kShareOfRest = 8;

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

/// Keeps the reason why a program failed: its first line about an error, else its last line with text.
void keep_reason(std::string_view line, std::string& reason) {
  const std::size_t begin = line.find_first_not_of(" =-\t\r");
  if (begin != std::string::npos && reason.find("rror") == std::string::npos) reason = line.substr(begin);
}

Words meniscus_command(const Bundle& bundle, Step step, const Order& order, const Frames& frames, bool alone) {
  // The frames of a run must come from one version, so PATH is not searched.
  Words words{system_file::program_path().string()};
  append(words, bundle.command);
  append(words, bundle.device);
  if (!order.device.empty()) std::erase(words, "--require-gpu");
  append(words, order.device);
  if (order.threads > 0) append(words, {"--threads", std::to_string(order.threads)});
  if (alone) append(words, {"--jobs", "1"});
  const std::string output = step == Step::render ? bundle.result_pattern(step) : "scene";
  append(words, {"--force", "-q", "--progress", "json", "-o", output, "--only", frame_list_text(frames)});
  return words;
}

Words blender_command(const Bundle& bundle, const Order& order, const std::string& pictures, const Frames& frames) {
  Words words{"blender", "-b", "--factory-startup"};
  if (order.threads > 0) append(words, {"-t", std::to_string(order.threads)});
  append(words, {"--python-exit-code", "3", "--python-expr", "import sys; sys.dont_write_bytecode = True", "--python",
                 "inputs/blender/render_mns.py", "--", "scene/surface_sequence.json", "--output", pictures, "--frames",
                 frame_list_text(frames)});
  append(words, bundle.renderer);
  return words;
}

Words povray_command(const Bundle& bundle, const Order& order, const std::string& picture, std::uint64_t frame) {
  constexpr const char* kScene = "surface.ini";
  Words words{"povray"};
  const auto is_scene = [](const std::string& word) { return word.starts_with(kScene); };
  if (std::ranges::none_of(bundle.renderer, is_scene)) words.emplace_back(kScene);
  append(words, bundle.renderer);
  if (order.threads > 0) words.push_back(fmt::format("+WT{}", order.threads));
  append(words, {fmt::format("+SF{}", frame), fmt::format("+EF{}", frame), "-D", "+FN", "+O" + picture});
  return words;
}

/// Gives a renderer's complete picture its name, removes the renderer's file, and reports the frame.
void take_picture(const Bundle& bundle, const Order& order, std::uint64_t frame, const fs::path& from, double seconds,
                  const FrameListener& listener) {
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::optional<std::string> picture = png_without_time(bytes);
  if (!picture) return listener.failed(frame, kExitInput, "the renderer did not write a complete PNG file");
  const std::string result = bundle.result(Step::render, frame);
  write_file(order.folder / result, *picture);
  fs::remove(from);
  listener.done(frame, {result}, seconds);
}

void make_by_povray(const Bundle& bundle, const Order& order, const Frames& frames, const FrameListener& listener) {
  for (const std::uint64_t frame : frames) {
    const auto begin = std::chrono::steady_clock::now();
    const HiddenFolder own(order.folder, "work");
    const std::string picture = (".." / own.path().filename() / "frame.png").string();
    std::string reason;
    int code = kSignalCode + 1;
    for (int tries = 0; tries < 2 && code > kSignalCode; ++tries) {
      ChildProcess child(povray_command(bundle, order, picture, frame), order.folder / "scene");
      while (const std::optional<std::string> line = child.next_line()) keep_reason(*line, reason);
      code = child.wait();
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    // POV-Ray adds the number of the frame to the name.
    const auto made = fs::directory_iterator(own.path());
    if (code > kSignalCode)
      listener.failed(frame, signal_exit_code(code), signal_text(code) + ", twice");
    else if (code != 0 || made == fs::directory_iterator())
      listener.failed(frame, kExitInput, fmt::format("povray ended with code {}: {}", code, reason));
    else
      take_picture(bundle, order, frame, made->path(), elapsed.count(), listener);
  }
}

void make_by_blender(const Bundle& bundle, const Order& order, const Frames& frames, const FrameListener& listener) {
  const HiddenFolder own(order.folder, "work");
  const std::string pictures = (own.path().filename() / "frame_#####.png").string();
  FrameListener hearing = listener;
  hearing.done = [&](std::uint64_t frame, const Words&, double seconds) {
    take_picture(bundle, order, frame, order.folder / numbered(pictures, frame), seconds, listener);
  };
  make_by_lines([&](const Frames& left, bool) { return blender_command(bundle, order, pictures, left); }, order.folder,
                frames, hearing);
}

/// Reports and removes the frame of a line that a program wrote. Returns false for a line that is for people.
bool take_line(const std::string& line, Frames& frames, const FrameListener& listener) {
  const json event = line.starts_with('{') ? json::parse(line, nullptr, false) : json();
  if (!event.is_object()) return false;
  if (!event.contains("frame") || !event.contains("state")) return true;
  const auto frame = event["frame"].get<std::uint64_t>();
  if (std::erase(frames, frame) == 0) return true;
  if (event["state"] == "done")
    listener.done(frame, event.value("files", Words()), event.value("ms", 0.0) / 1000.0);
  else
    listener.failed(frame, event.value("exit", static_cast<int>(kExitInternal)), event.value("error", "no reason"));
  return true;
}

/// Makes these frames of the step, in this order, and reports each. A process that a signal ends is started once more,
/// for one frame after another, so that the frame that ended it is known. Throws RunError with the process' own exit
/// code if it cannot work at all, InputError if it cannot be started.
void make_frames(const Bundle& bundle, Step step, const Order& order, const Frames& frames,
                 const FrameListener& listener) {
  {
    const StopBarrier barrier;  // the folder may be a hidden one, which a signal removes
    make_folders_of(order.folder / bundle.result_pattern(step));
  }
  const Maker maker = bundle.maker(step);
  if (maker == Maker::povray) return make_by_povray(bundle, order, frames, listener);
  if (maker == Maker::blender) return make_by_blender(bundle, order, frames, listener);
  make_by_lines([&](const Frames& left, bool alone) { return meniscus_command(bundle, step, order, left, alone); },
                order.folder, frames, listener);
}

class Worker {
 public:
  Worker(const Bundle& bundle, const Order& order, ProgressStyle style)
      : bundle_(bundle),
        order_(order),
        open_(order.force ? order.frames : missing_frames(bundle, order.folder, order.steps.back(), order.frames)),
        progress_(style, false, open_.size()) {}

  double run() {
    for (Frames batch = next_batch(); !batch.empty(); batch = next_batch()) {
      const auto begin = std::chrono::steady_clock::now();
      const double before = seconds_;
      for (const Step step : order_.steps) make(step, batch);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
      const double start = std::max(0.0, elapsed.count() - (seconds_ - before));
      const double frame = (seconds_ - before) / static_cast<double>(batch.size());
      worthwhile_ = frame > 0.0 ? start / (kStartShare * frame) : worthwhile_;
    }
    progress_.end();
    if (!failed_.empty())
      throw RunError(first_code_, "{} of {} frames failed; the first, {}", with_thousands(failed_.size()),
                     with_thousands(order_.frames.size()), first_error_);
    return seconds_;
  }

 private:
  /// Returns consecutive frames and removes them from those that are open: all of a chunk that is this worker's alone,
  /// else some from a random place.
  Frames next_batch() {
    if (order_.is_whole_run) open_ = missing_of(order_.steps.back(), open_);
    if (!order_.is_whole_run || open_.empty()) return std::exchange(open_, {});
    std::uniform_int_distribution<std::ptrdiff_t> any(0, std::ssize(open_) - 1);
    const auto first = open_.begin() + any(random_);
    const double most = std::max(1.0, static_cast<double>(open_.size() / kShareOfRest));
    const auto size = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(worthwhile_), 1.0, most));
    const auto limit = first + std::min(size, open_.end() - first);
    const auto in_run = std::ranges::find(order_.frames, *first);
    const auto last = std::mismatch(first, limit, in_run, order_.frames.end()).first;
    Frames batch(first, last);
    open_.erase(first, last);
    return batch;
  }

  /// Returns those frames that have no result of the step. At the last step it reports the others as done.
  Frames missing_of(Step step, const Frames& frames) {
    if (order_.force) return frames;
    Frames missing = missing_frames(bundle_, order_.folder, step, frames);
    if (step != order_.steps.back()) return missing;
    const std::set<std::uint64_t> is_missing(missing.begin(), missing.end());
    for (const std::uint64_t frame : frames)
      if (!is_missing.contains(frame)) progress_.done(frame, {bundle_.result(step, frame)}, 0.0);
    return missing;
  }

  void make(Step step, const Frames& batch) {
    if (order_.is_whole_run && bundle_.maker(step) == Maker::povray && batch.size() > 1) {
      // A process makes one frame, so there is time to check before each; workers with the same batch seldom meet.
      Frames shuffled = batch;
      std::ranges::shuffle(shuffled, random_);
      for (const std::uint64_t frame : shuffled) make(step, {frame});
      return;
    }
    Frames frames;
    std::ranges::copy_if(batch, std::back_inserter(frames), [&](auto frame) { return !failed_.contains(frame); });
    frames = missing_of(step, frames);
    if (frames.empty()) return;
    FrameListener listener;
    listener.done = [&](std::uint64_t frame, const std::vector<std::string>& files, double seconds) {
      seconds_ += seconds;
      if (step == Step::surface) list_scene(frame, files);
      if (step == order_.steps.back()) progress_.done(frame, files, 1000.0 * seconds);
    };
    listener.failed = [&](std::uint64_t frame, int code, const std::string& error) {
      // Another worker may have made it, and replaced files that were being read.
      if (order_.force || !missing_of(order_.steps.back(), {frame}).empty()) fail(frame, code, error);
    };
    make_frames(bundle_, step, order_, frames, listener);
  }

  /// Writes the sizes and the names of a scene's files. This list is the scene's last file.
  void list_scene(std::uint64_t frame, const std::vector<std::string>& files) const {
    std::string list;
    for (const std::string& file : files) list += fmt::format("{} {}\n", fs::file_size(order_.folder / file), file);
    write_file(order_.folder / bundle_.result(Step::surface, frame), list);
  }

  void fail(std::uint64_t frame, int code, const std::string& error) {
    if (failed_.empty()) {
      first_code_ = static_cast<ExitCode>(code);
      first_error_ = fmt::format("frame {}: {}", frame, error);
    }
    failed_.insert(frame);
    progress_.failed(frame, code, error);
  }

  const Bundle& bundle_;
  const Order& order_;
  Frames open_;  ///< frames that this worker has not tried and that were missing at its last check
  RunProgress progress_;
  std::mt19937 random_{std::random_device{}()};
  double worthwhile_ = 1.0;  ///< least number of frames for one process
  double seconds_ = 0.0;     ///< seconds that all frames took
  std::set<std::uint64_t> failed_;
  ExitCode first_code_ = kExitOk;
  std::string first_error_;
};

}  // namespace

void make_by_lines(const std::function<Words(const Frames& frames, bool alone)>& command_for, const fs::path& folder,
                   Frames frames, const FrameListener& listener) {
  std::optional<std::uint64_t> tried;  // the frame that was given a second process
  while (!frames.empty()) {
    ChildProcess child(command_for(frames, tried.has_value()), folder);
    std::string reason;
    while (const std::optional<std::string> line = child.next_line())
      if (!take_line(*line, frames, listener)) keep_reason(*line, reason);
    const int code = child.wait();
    if (frames.empty()) return;
    // This reason is printed after the program's own prefix, which appears once.
    constexpr std::string_view kPrefix = "meniscus: error: ";
    if (reason.starts_with(kPrefix)) reason.erase(0, kPrefix.size());
    const std::uint64_t culprit = frames.front();
    if (code <= kSignalCode) {
      // The process ended by itself before the last frame, and another one would do the same.
      throw RunError(code == kExitOk ? kExitInternal : static_cast<ExitCode>(code), "frame {}{} not made: {}", culprit,
                     frames.size() == 1 ? " was" : fmt::format(" and {} more were", frames.size() - 1),
                     reason.empty() ? fmt::format("exit code {}", code) : reason);
    }
    if (tried == culprit) {
      frames.erase(frames.begin());
      listener.failed(culprit, signal_exit_code(code), signal_text(code) + ", twice");
    }
    tried = culprit;
  }
}

double work(const Bundle& bundle, const Order& order, ProgressStyle progress) {
  // Frames of one film must not come from two programs.
  if (bundle.program_version != build_version())
    throw InputError((order.folder / "bundle.json").string(), 0,
                     "was made by meniscus {}, and this is {}; use one build on all machines",
                     in_quotes(bundle.program_version), build_version());
  check_inputs(bundle, order.folder, false);
  return Worker(bundle, order, progress).run();
}

}  // namespace meniscus::farm
