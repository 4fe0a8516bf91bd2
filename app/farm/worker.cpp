// SPDX-License-Identifier: BSD-3-Clause
// Finds missing frames, has them made, and keeps the records.
#include "app/farm/worker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <list>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "app/farm/check_bundle.h"
#include "app/farm/checksum.h"
#include "app/farm/claims.h"
#include "app/farm/frame_log.h"
#include "app/farm/frame_record.h"
#include "app/farm/inner_path.h"
#include "app/farm/pause.h"
#include "app/farm/quote.h"
#include "app/process/program_error.h"
#include "app/process/this_program.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

constexpr std::uint64_t kQuickToCheck = std::uint64_t{256} << 20;  // bytes; a tenth of a second

/// The frames that failed in any step, and why the first did.
struct Failures {
  std::set<std::uint64_t> frames;
  std::uint64_t first = 0;
  int code = 0;
  std::string message;

  void add(std::uint64_t frame, int exit_code, const std::string& error) {
    if (!frames.insert(frame).second || frames.size() > 1) return;
    first = frame;
    code = exit_code;
    message = error;
  }
};

// A process begins slowly: with so many frames that its start is a thirtieth of its time.
constexpr double kStartShare = 1.0 / 30.0;
constexpr std::chrono::milliseconds kShortestWait(50), kLongestWait(1000);

/// How long the processes of a step need to begin, and for each frame.
struct Pace {
  double start_seconds = 0.0, frame_seconds = 0.0;

  /// Frames that one process should make at least.
  double worthwhile() const { return frame_seconds > 0.0 ? start_seconds / (kStartShare * frame_seconds) : 1.0; }
};

/// One step: what is still to be made or waited for.
struct Task {
  Task(const Step& which, std::vector<std::uint64_t> missing, ProgressStyle style)
      : step(which), open(std::move(missing)), progress(style, false, open.size()) {}
  const Step& step;
  std::vector<std::uint64_t> open;  ///< frames that have neither failed nor a good record, as far as is known
  RunProgress progress;
  Pace pace;
};

/// Thrown out of the middle of a batch when the bundle is paused.
struct Paused {};

class Worker {
 public:
  Worker(const Bundle& bundle, const Workplace& place, const Assignment& assignment, ProgressStyle progress)
      : bundle_(bundle),
        place_(place),
        assignment_(assignment),
        style_(progress),
        records_(place.folder, bundle),
        claims_(place.folder, assignment.lease_seconds) {}

  void run() {
    for (const std::string& name : assignment_.steps) {
      const Step& step = *bundle_.step(name);
      tasks_.emplace_back(step, missing_of(step), style_);
      make(tasks_.back());
    }
    wait_for_others();
    for (Task& task : tasks_) task.progress.end();
    if (!failures_.frames.empty())
      throw RunError(
          static_cast<ExitCode>(failures_.code),
          fmt::format("{} of {} frames failed; the first, frame {}: {}", with_thousands(failures_.frames.size()),
                      with_thousands(assignment_.frames.size()), failures_.first, failures_.message));
  }

 private:
  /// What a frame needs before it can be made.
  enum class Way { free, waits, settled };

  std::vector<std::uint64_t> missing_of(const Step& step) const {
    std::vector<std::uint64_t> missing;
    for (const std::uint64_t frame : assignment_.frames) {
      const bool hopeless = failures_.frames.contains(frame);  // a step before failed just now
      if (!hopeless && (assignment_.force || !is_good(records_.read(step.name, frame)))) missing.push_back(frame);
    }
    return missing;
  }

  bool is_good(const std::optional<FrameRecord>& record) const {
    return record && record->done() && records_.fault(*record).empty();
  }

  /// Whether its record says what became of the frame while this worker was there.
  bool is_recent(const Step& step, std::uint64_t frame) const {
    const std::optional<FileTime> when = records_.written(step.name, frame);
    return when && *when > claims_.begin();
  }

  /// Makes what nobody else makes, until all of the step is made or claimed.
  void make(Task& task) {
    while (true) {
      wait_while_paused(task);
      batch_ = next_batch(task);
      if (batch_.empty()) return;
      begin_ = std::chrono::steady_clock::now();
      first_ = true;
      log_.take();  // what was said after the last frame of a batch before
      try {
        make_frames(bundle_, task.step, place_, std::vector(batch_), listener(task));
      } catch (const Paused&) {
        for (const std::uint64_t frame : batch_) claims_.give_back(task.step.name, frame);
        task.open.insert(task.open.begin(), batch_.begin(), batch_.end());
      }
    }
  }

  void wait_while_paused(Task& task) {
    if (!is_paused(place_.folder)) return;
    task.progress.tell(fmt::format("paused; to go on: meniscus farm resume {}", shell_word(place_.folder.string())));
    while (is_paused(place_.folder)) std::this_thread::sleep_for(kLongestWait);
  }

  /// The chunk of an engine is one worker's alone. Of the whole run each worker takes half of what would be fair, so
  /// that all come to the end together (guided self-scheduling: Polychronopoulos & Kuck, IEEE Trans. Comput. 1987).
  std::size_t batch_size(const Task& task) {
    const auto open = static_cast<double>(task.open.size());
    if (assignment_.alone || open == 0.0) return task.open.size();
    const double fair = open / static_cast<double>(claims_.others() + 1);
    return static_cast<std::size_t>(std::ceil(std::min(fair, std::max(fair / 2.0, task.pace.worthwhile()))));
  }

  /// Frames that are this worker's from now on.
  std::vector<std::uint64_t> next_batch(Task& task) {
    const std::size_t size = batch_size(task);
    std::vector<std::uint64_t> batch;
    std::erase_if(task.open, [&](std::uint64_t frame) {
      if (batch.size() == size) return false;
      const Way way = way_to(task, frame);
      if (way == Way::free) batch.push_back(frame);
      return way != Way::waits;
    });
    return batch;
  }

  Way way_to(Task& task, std::uint64_t frame) {
    if (failures_.frames.contains(frame) || is_settled(task, frame)) return Way::settled;
    std::string why;
    const int code = obstacle(task.step, frame, why);
    if (code != 0) {
      if (is_before_open(task.step, frame)) return Way::waits;
      fail(task, frame, code, why);
      return Way::settled;
    }
    if (rests(task.step.name, frame) || !claims_.take(task.step.name, frame)) return Way::waits;
    // Another may have made it, or failed in it, between the looks above.
    const bool settled = is_settled(task, frame);
    if (!settled && !rests(task.step.name, frame)) return Way::free;
    claims_.give_back(task.step.name, frame);
    return settled ? Way::settled : Way::waits;
  }

  /// Whether a frame that failed will be tried again, by this worker or one like it.
  bool has_another_try(const FrameRecord& record) const {
    return !record.done() && record.again && record.tries < assignment_.tries.most;
  }

  /// Whether it is too early for that.
  bool rests(const std::string& step, std::uint64_t frame) {
    const std::optional<FrameRecord> record = records_.read(step, frame);
    return record && has_another_try(*record) && age(step, frame) < *record->again;
  }

  /// Of a record, in seconds.
  double age(const std::string& step, std::uint64_t frame) {
    return seconds_between(records_.written(step, frame).value_or(0), claims_.now());
  }

  /// Whether another has made the frame, or failed in it, since this worker began.
  bool is_settled(Task& task, std::uint64_t frame) {
    const std::optional<FrameRecord> record = records_.read(task.step.name, frame);
    if (!record) return false;
    if (record->done()) return (!assignment_.force || is_recent(task.step, frame)) && is_good(record);
    if (has_another_try(*record) || !is_recent(task.step, frame)) return false;
    fail(task, frame, record->exit_code, record->error);
    return true;
  }

  /// Why the frame cannot be made: the step before has not made it. 0: it can.
  int obstacle(const Step& step, std::uint64_t frame, std::string& why) const {
    if (&step == bundle_.steps.data()) return 0;
    const std::string& before = (&step - 1)->name;
    const std::optional<FrameRecord> record = records_.read(before, frame);
    if (record && !record->done()) {
      why = fmt::format("step {} failed: {}", before, record->error);
      return record->exit_code;
    }
    const std::string fault = record ? records_.fault(*record) : std::string("it is not made yet");
    if (fault.empty()) return 0;
    why = fmt::format("step {}: {}; run that step first", before, fault);
    return kExitInput;
  }

  /// Whether the step before is being made: here, later, or by another.
  bool is_before_open(const Step& step, std::uint64_t frame) {
    const Step& before = *(&step - 1);
    for (const Task& task : tasks_)
      if (&task.step == &before && std::ranges::find(task.open, frame) != task.open.end()) return true;
    const std::optional<FrameRecord> record = records_.read(before.name, frame);
    if (record && !record->done() && record->again && age(before.name, frame) < *record->again + kDefaultLease)
      return true;
    return claims_.is_taken(before.name, frame);
  }

  void fail(Task& task, std::uint64_t frame, int code, const std::string& why) {
    failures_.add(frame, code, why);
    task.progress.failed(frame, code, why);
  }

  /// Frames that others had claimed: made by them meanwhile, or given up.
  void wait_for_others() {
    auto wait = kShortestWait;
    while (std::ranges::any_of(tasks_, [](const Task& task) { return !task.open.empty(); })) {
      std::this_thread::sleep_for(wait);
      wait = std::min(2 * wait, kLongestWait);
      for (Task& task : tasks_) make(task);
    }
  }

  FrameListener listener(Task& task) {
    const std::string& step = task.step.name;
    FrameListener listener;
    listener.done = [&](std::uint64_t frame, const std::vector<std::string>& files, double seconds) {
      FrameRecord record = records_.measured(frame, files, seconds);
      if (first_ && step == "surface") records_.write_shared(step);
      keep(step, record);
      measure(task.pace, seconds);
      task.progress.done(frame, files, 1000.0 * seconds);
      stop_if_paused();
    };
    listener.failed = [&](std::uint64_t frame, int code, const std::string& error) {
      const std::optional<FrameRecord> before = records_.read(step, frame);
      FrameRecord record;
      record.frame = frame;
      record.exit_code = code;
      record.error = error;
      if (before && has_another_try(*before)) record.tries = before->tries + 1;
      record.again = assignment_.tries.wait_after(record.tries);
      keep(step, record);
      if (record.again) {
        task.open.push_back(frame);
        task.progress.tell(fmt::format("frame {} failed, try {} of {}, the next in {:.3g} s: {}", frame, record.tries,
                                       assignment_.tries.most, *record.again, escaped(error)));
      } else {
        fail(task, frame, code, error);
      }
      stop_if_paused();
    };
    listener.tried_again = [&](std::uint64_t, const std::string& error) {
      first_try_ = error;
      log_.add(fmt::format("-- {}; once more --", error));
    };
    listener.said = [&](const std::string& line) { log_.add(line); };
    return listener;
  }

  /// What is known of a frame that is over, and what was said of it; then others may have it.
  void keep(const std::string& step, FrameRecord& record) {
    record.first_try = std::exchange(first_try_, {});
    record.worker = claims_.name();
    record.ended = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    write_frame_log(place_.folder, step, record.frame, log_.take());
    records_.write(step, record);
    claims_.give_back(step, record.frame);
    std::erase(batch_, record.frame);
  }

  void stop_if_paused() const {
    if (!batch_.empty() && is_paused(place_.folder)) throw Paused{};
  }

  void measure(Pace& pace, double seconds) {
    if (std::exchange(first_, false)) {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
      pace.start_seconds = std::max(0.0, elapsed.count() - seconds);
    }
    pace.frame_seconds = seconds;
  }

  const Bundle& bundle_;
  const Workplace& place_;
  const Assignment& assignment_;
  ProgressStyle style_;
  FrameRecords records_;
  Claims claims_;
  Failures failures_;
  std::list<Task> tasks_;
  std::vector<std::uint64_t> batch_;  ///< frames at work
  std::string first_try_;             ///< of the frame at work
  FrameLog log_;                      ///< likewise
  std::chrono::steady_clock::time_point begin_;
  bool first_ = true;  ///< no frame of this batch is made yet
};

}  // namespace

void check_inputs(const Bundle& bundle, const std::filesystem::path& folder, bool thorough) {
  std::error_code none_there;
  for (const Input& input : bundle.inputs) {
    const std::string path = input_path(input, folder).string();
    const bool elsewhere = path == input.source;
    if (elsewhere ? !std::filesystem::is_regular_file(path, none_there)
                  : inner_entry(folder, input.path) != Entry::file)
      throw InputError(path, 0,
                       elsewhere ? fmt::format("is missing; bring it there, or to {}", (folder / input.path).string())
                                 : "is missing; make the bundle again");
    const std::uintmax_t bytes = std::filesystem::file_size(path);
    // A file elsewhere is always read to its end: a stranger's bundle must not learn whether a file has some size.
    const bool quick = !thorough && !elsewhere && bytes > kQuickToCheck;
    if (bytes != input.bytes || (!quick && sha256_of_file(path) != input.sha256))
      throw InputError(path, 0, "is not what was bundled (size or SHA-256); make the bundle again");
  }
}

void work(const Bundle& bundle, const Workplace& place, const Assignment& assignment, ProgressStyle progress) {
  // Frames of one film must not come from two programs.
  if (bundle.program_version != build_version())
    throw InputError((place.folder / "bundle.json").string(), 0,
                     fmt::format("was made by meniscus {}, and this is {}; use one build on all machines",
                                 in_quotes(bundle.program_version), build_version()));
  check_places(place.folder);
  check_inputs(bundle, place.folder, false);
  Worker(bundle, place, assignment, progress).run();
}

}  // namespace meniscus::farm
