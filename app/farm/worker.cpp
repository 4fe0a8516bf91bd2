// SPDX-License-Identifier: BSD-3-Clause
// Finds missing frames, and has them made.
#include "app/farm/worker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/farm/missing_frames.h"
#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/this_program.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;
using Frames = std::vector<std::uint64_t>;

constexpr std::uint64_t kQuickToCheck = std::uint64_t{256} << 20;  // bytes; a tenth of a second

// A process begins slowly, and makes so many frames that its start is a twentieth of its time.
constexpr double kStartShare = 1.0 / 20.0;
// But never more than this part of what is missing, so that workers come to the end together (guided self-scheduling:
// Polychronopoulos & Kuck, IEEE Trans. Comput. 1987).
constexpr std::size_t kShareOfRest = 8;
// How often a worker goes elsewhere though its next frames are missing: two that began at the same frame part again.
constexpr double kRestlessness = 0.25;

/// The path of a result in the bundle.
std::string result_of(const Bundle& bundle, Step step, std::uint64_t frame) {
  return numbered(bundle.result_pattern(step), frame);
}

class Worker {
 public:
  Worker(const Bundle& bundle, const Workplace& place, const Share& share, ProgressStyle style)
      : bundle_(bundle),
        place_(place),
        share_(share),
        open_(share.force ? share.frames : missing_frames(bundle, place.folder, share.steps.back(), share.frames)),
        progress_(style, false, open_.size()) {}

  double run() {
    for (Frames batch = next_batch(); !batch.empty(); batch = next_batch()) {
      const auto begin = std::chrono::steady_clock::now();
      const double before = seconds_;
      for (const Step step : share_.steps) make(step, batch);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
      const double start = std::max(0.0, elapsed.count() - (seconds_ - before));
      const double frame = (seconds_ - before) / static_cast<double>(batch.size());
      worthwhile_ = frame > 0.0 ? start / (kStartShare * frame) : worthwhile_;
    }
    progress_.end();
    if (!failed_.empty())
      throw RunError(first_code_,
                     fmt::format("{} of {} frames failed; the first, frame {}: {}", with_thousands(failed_.size()),
                                 with_thousands(share_.frames.size()), first_failed_, first_error_));
    return seconds_;
  }

 private:
  /// Takes frames that follow each other off those that are open: all of a share that is this worker's alone. It goes
  /// on behind its last ones; where another has been there already, it looks for a new place.
  Frames next_batch() {
    if (share_.is_whole_run) open_ = missing_of(share_.steps.back(), open_);
    if (!share_.is_whole_run || open_.empty()) return std::exchange(open_, {});
    const bool stays = next_ && !std::bernoulli_distribution(kRestlessness)(random_);
    auto first = stays ? std::ranges::find(open_, *next_) : open_.end();
    if (first == open_.end()) {
      std::uniform_int_distribution<std::ptrdiff_t> any(0, std::ssize(open_) - 1);
      first = open_.begin() + any(random_);
    }
    const double most = std::max(1.0, static_cast<double>(open_.size() / kShareOfRest));
    const auto size = static_cast<std::size_t>(std::clamp(std::ceil(worthwhile_), 1.0, most));
    auto in_run = std::ranges::find(share_.frames, *first);
    auto last = first;
    Frames batch;
    while (last != open_.end() && *last == *in_run && batch.size() < size) {
      batch.push_back(*last++);
      ++in_run;
    }
    next_ = in_run == share_.frames.end() ? std::nullopt : std::optional(*in_run);
    open_.erase(first, last);
    return batch;
  }

  /// Returns those frames that have no result of the step. At the last step it reports the others as done.
  Frames missing_of(Step step, const Frames& frames) {
    if (share_.force) return frames;
    Frames missing = missing_frames(bundle_, place_.folder, step, frames);
    if (step != share_.steps.back()) return missing;
    const std::set<std::uint64_t> is_missing(missing.begin(), missing.end());
    for (const std::uint64_t frame : frames)
      if (!is_missing.contains(frame)) progress_.done(frame, {result_of(bundle_, step, frame)}, 0.0);
    return missing;
  }

  void make(Step step, const Frames& batch) {
    if (share_.is_whole_run && bundle_.maker(step) == Maker::povray && batch.size() > 1) {
      // A process makes one frame, so there is time to look before each; workers with the same batch seldom meet.
      Frames shuffled = batch;
      std::ranges::shuffle(shuffled, random_);
      for (const std::uint64_t frame : shuffled) make(step, {frame});
      return;
    }
    Frames frames;
    std::ranges::copy_if(batch, std::back_inserter(frames), [&](auto frame) { return !failed_.contains(frame); });
    frames = missing_of(step, frames);
    if (step == Step::render && bundle_.steps().size() > 1) drop_without_scene(frames);
    if (frames.empty()) return;
    FrameListener listener;
    listener.done = [&](std::uint64_t frame, const std::vector<std::string>& files, double seconds) {
      seconds_ += seconds;
      if (step == Step::surface) mark_scene(frame, files);
      if (step == share_.steps.back()) progress_.done(frame, files, 1000.0 * seconds);
    };
    listener.failed = [&](std::uint64_t frame, int code, const std::string& error) {
      // Another worker may have made it, and replaced files that were being read.
      if (share_.force || !missing_of(share_.steps.back(), {frame}).empty()) fail(frame, code, error);
    };
    make_frames(bundle_, step, place_, frames, listener);
  }

  /// A scene may be of several files, so a last one names them.
  void mark_scene(std::uint64_t frame, const std::vector<std::string>& files) const {
    const StopBarrier barrier;
    OutputFile mark(place_.folder / result_of(bundle_, Step::surface, frame), Existing::replace);
    for (const std::string& file : files) mark.write(fmt::format("{} {}\n", fs::file_size(place_.folder / file), file));
    mark.commit();
  }

  void drop_without_scene(Frames& frames) {
    for (const std::uint64_t frame : missing_frames(bundle_, place_.folder, Step::surface, frames)) {
      fail(frame, kExitInput, "its scene is not made yet; leave --step out, or run --step surface first");
      std::erase(frames, frame);
    }
  }

  void fail(std::uint64_t frame, int code, const std::string& error) {
    if (failed_.empty()) {
      first_failed_ = frame;
      first_code_ = static_cast<ExitCode>(code);
      first_error_ = error;
    }
    failed_.insert(frame);
    progress_.failed(frame, code, error);
  }

  const Bundle& bundle_;
  const Workplace& place_;
  const Share& share_;
  Frames open_;  ///< frames that this worker neither made nor tried, and that were missing when it looked last
  RunProgress progress_;
  std::mt19937 random_{std::random_device{}()};
  std::optional<std::uint64_t> next_;  ///< the frame behind the last batch
  double worthwhile_ = 1.0;            ///< frames that one process should make at least
  double seconds_ = 0.0;               ///< that frames took
  std::set<std::uint64_t> failed_;
  std::uint64_t first_failed_ = 0;
  ExitCode first_code_ = kExitOk;
  std::string first_error_;
};

/// True if the files of a scene have the sizes that its mark lists.
bool is_whole_scene(const fs::path& folder, const std::string& mark) {
  std::ifstream lines(mark);
  std::uintmax_t bytes = 0;
  std::error_code none;
  for (std::string file; lines >> bytes >> file;)
    if (fs::file_size(folder / file, none) != bytes) return false;
  return true;
}

}  // namespace

Frames missing_frames(const Bundle& bundle, const fs::path& folder, Step step, const Frames& frames) {
  std::vector<std::string> paths;
  for (const std::uint64_t frame : frames) paths.push_back((folder / result_of(bundle, step, frame)).string());
  const std::vector<std::size_t> places = missing_files(paths);
  Frames missing;
  for (std::size_t n = 0, next = 0; n < frames.size(); ++n) {
    const bool is_missing = next < places.size() && places[next] == n;
    if (is_missing) ++next;
    if (is_missing || (step == Step::surface && !is_whole_scene(folder, paths[n]))) missing.push_back(frames[n]);
  }
  return missing;
}

void check_inputs(const Bundle& bundle, const fs::path& folder, bool thorough) {
  for (const Input& input : bundle.inputs) {
    const fs::path path = folder / input.path;  // of an absolute path, that path
    std::error_code none;
    if (!fs::is_regular_file(path, none))
      throw InputError(path.string(), 0, "is missing; bring it there, or make the bundle again");
    const std::uintmax_t bytes = fs::file_size(path);
    const bool quick = !thorough && bytes > kQuickToCheck;
    if (bytes != input.bytes || (!quick && sha256_of_file(path) != input.sha256))
      throw InputError(path.string(), 0, "is not what was bundled (size or SHA-256); make the bundle again");
  }
}

double work(const Bundle& bundle, const Workplace& place, const Share& share, ProgressStyle progress) {
  // Frames of one film must not come from two programs.
  if (bundle.program_version != build_version())
    throw InputError((place.folder / "bundle.json").string(), 0,
                     fmt::format("was made by meniscus {}, and this is {}; use one build on all machines",
                                 in_quotes(bundle.program_version), build_version()));
  check_inputs(bundle, place.folder, false);
  return Worker(bundle, place, share, progress).run();
}

}  // namespace meniscus::farm
