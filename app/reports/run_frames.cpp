// SPDX-License-Identifier: BSD-3-Clause
// Makes frames on several threads, finishes them in order, and reports progress.
#include "app/reports/run_frames.h"

#include <iostream>

#include <fmt/ostream.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "app/reports/notes.h"
#include "core/base/ordered_jobs.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

void write_line(const Json& json) {
  std::cerr << json.dump(-1, ' ', true, Json::error_handler_t::replace) << std::endl;
}

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

RunProgress::RunProgress(ProgressStyle style, bool quiet, std::uint64_t frames, std::size_t at_once, const char* word)
    : style_(style), word_(word), total_(frames), begin_(std::chrono::steady_clock::now()) {
  if (style_ == ProgressStyle::automatic)
    style_ = quiet                                 ? ProgressStyle::none
             : system_process::is_terminal(stderr) ? ProgressStyle::bar
                                                   : ProgressStyle::plain;
  if (style_ == ProgressStyle::json) write_line({{"event", "start"}, {word_ + "s", total_}, {"at_once", at_once}});
}

void RunProgress::done(std::uint64_t frame, const std::vector<std::string>& files, double milliseconds, bool empty) {
  if (style_ == ProgressStyle::json) {
    Json line{{"event", word_}, {word_, frame}, {"state", "done"}, {"files", files}, {"ms", milliseconds}};
    if (empty) line["empty"] = true;
    write_line(line);
  }
  advance();
}

void RunProgress::failed(std::uint64_t frame, int exit_code, const std::string& message) {
  ++failed_;
  if (style_ == ProgressStyle::json) {
    write_line({{"event", word_}, {word_, frame}, {"state", "failed"}, {"exit", exit_code}, {"error", message}});
  } else {
    if (style_ == ProgressStyle::bar) std::cerr << "\r\033[K";
    std::cerr << "meniscus: " << word_ << " " << frame << " failed: " << escaped(message) << std::endl;
  }
  advance();
}

void RunProgress::advance() {
  ++done_;
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  const double each = elapsed.count() / static_cast<double>(done_);
  const std::string rest = done_ < total_ ? ", " + duration(each * static_cast<double>(total_ - done_)) + " left" : "";
  const std::string rate = fmt::format("{} of {} {}s, {:.2f} s each{}", done_, total_, word_, each, rest);
  if (style_ == ProgressStyle::bar) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * share);
    fmt::print(std::cerr, "\r\033[K[{:#<{}}{:.<{}}] {}", "", filled, "", kWidth - filled, rate);
    std::cerr.flush();
  } else if (style_ == ProgressStyle::plain) {
    const int tenth = static_cast<int>(10.0 * share);
    if (tenth != last_tenth_) std::cerr << "meniscus: " << rate << std::endl;
    last_tenth_ = tenth;
  } else if (style_ == ProgressStyle::openjd) {
    std::cout << fmt::format("openjd_progress: {:.1f}\nopenjd_status: {}", 100.0 * share, rate) << std::endl;
  }
}

void RunProgress::end() {
  if (style_ == ProgressStyle::bar && done_ > 0) std::cerr << std::endl;
  if (style_ == ProgressStyle::json) write_line({{"event", "end"}, {"done", done_ - failed_}, {"failed", failed_}});
}

namespace {

bool ends_the_run(const std::exception& error) {
  const ExitCode code = exit_code_of(error);
  return code == kExitOutput || code == kExitGpu || code == kExitUsage || code == kExitInternal;
}

/// The first frame that failed, and the number of failures.
struct Failures {
  std::uint64_t count = 0, frame = 0;
  ExitCode code = kExitOk;
  std::string message;
};

/// The first picture with some fault, and the number of such pictures.
struct FaultyPictures {
  std::uint64_t count = 0, first = 0;

  void note(std::uint64_t frame, bool is_faulty) {
    if (is_faulty && count++ == 0) first = frame;
  }
  /// Returns "3 of the pictures show nothing (first: frame 7)".
  std::string words(const char* one, const char* many) const {
    return fmt::format("{} of the pictures {} (first: frame {})", with_thousands(count), count == 1 ? one : many,
                       first);
  }
};

void log_faults(const SceneCommand& command, const FaultyPictures& empty, const FaultyPictures& unlabelled) {
  if (empty.count > 0)
    log_line(command,
             fmt::format("warning: {}: the camera sees no part of the surface that --show keeps; check where it looks",
                         empty.words("shows nothing", "show nothing")));
  if (unlabelled.count > 0)
    log_line(command, fmt::format("warning: {}: there is no room for all labels without overlaps; use fewer or shorter "
                                  "labels, smaller letters (--label-size), or larger pictures",
                                  unlabelled.words("lacks its labels", "lack their labels")));
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// A frame that was read, or the error.
struct Read {
  std::optional<RunFrame> frame;
  std::exception_ptr error;
  Clock::time_point begin;
};

/// A frame to finish, and the time spent on it so far.
struct Prepared {
  FinishFrame finish;
  double milliseconds;
};

using Jobs = OrderedJobs<Read, Prepared>;

Read read_next(FrameRun& frames) {
  Read read{std::nullopt, nullptr, Clock::now()};
  try {
    read.frame = frames.next();
  } catch (...) {
    read.error = std::current_exception();
  }
  return read;
}

/// Returns a job that uses a part of the cores.
Jobs::Worker job_of(FrameWorker worker, std::shared_ptr<tbb::task_arena> cores) {
  return [worker = std::move(worker), cores = std::move(cores)](Read read) {
    if (read.error) std::rethrow_exception(read.error);
    FinishFrame finish = cores->execute([&] { return worker(std::move(*read.frame)); });
    return Prepared{std::move(finish), milliseconds_since(read.begin)};
  };
}

std::vector<Jobs::Worker> jobs_of(std::vector<FrameWorker> workers) {
  const auto cores = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const int each = std::max(1, static_cast<int>(cores / workers.size()));
  std::vector<Jobs::Worker> jobs;
  for (FrameWorker& worker : workers) {
    auto arena = std::make_shared<tbb::task_arena>(each);
    arena->initialize();  // without memory for the first frame it would otherwise wait for itself forever in the next
    jobs.push_back(job_of(std::move(worker), std::move(arena)));
  }
  return jobs;
}

std::size_t frames_at_once(const FrameRun& frames, const SceneCommand& command, std::uint64_t frame_bytes) {
  if (command.jobs > 0) return command.jobs;
  // Each thread takes far more address space than memory.
  if (memory_is_limited()) return 1;
  const auto cores =
      static_cast<std::uint64_t>(command.scene.molecule.surface.threads > 0 ? command.scene.molecule.surface.threads
                                                                            : tbb::info::default_concurrency());
  constexpr std::uint64_t kPartOfMemory = 4;  // the rest is for other programs, and for the files read
  const std::uint64_t fit = memory_size() / kPartOfMemory / std::max<std::uint64_t>(1, frame_bytes);
  return std::max<std::uint64_t>(1, std::min({cores, fit, std::uint64_t{frames.chunk().size()}}));
}

}  // namespace

std::vector<std::shared_ptr<MoleculeBuilder>> frame_builders(const FrameRun& frames, const SceneCommand& command,
                                                             std::uint64_t frame_bytes, const EglContext* context) {
  std::vector<std::shared_ptr<MoleculeBuilder>> builders{
      std::make_shared<MoleculeBuilder>(command.scene.molecule, context)};
  if (!builders.front()->is_on_cpu()) return builders;
  const std::size_t count = frames_at_once(frames, command, frame_bytes);
  while (builders.size() < count)
    builders.push_back(std::make_shared<MoleculeBuilder>(command.scene.molecule, context));
  return builders;
}

void warn_beyond_map(const SceneCommand& command, std::span<const std::shared_ptr<MoleculeBuilder>> builders) {
  double most = 0.0;
  for (const std::shared_ptr<MoleculeBuilder>& builder : builders) most = std::max(most, builder->most_beyond_map());
  warn_beyond_map(command, most, "the surface of one frame, and no more of any other,");
}

void run_frames(FrameRun& frames, const SceneCommand& command, std::vector<FrameWorker> workers) {
  RunProgress progress(command.reporting.progress, command.reporting.quiet, frames.chunk().size(), workers.size());
  Failures failures;
  FaultyPictures empty, unlabelled;
  // In addition to the frames at work, one waits to start, and one to be finished.
  const std::size_t most_pending = workers.size() == 1 ? 1 : workers.size() + 2;
  Jobs jobs(jobs_of(std::move(workers)));
  std::size_t begun = 0;
  for (const std::uint64_t number : frames.chunk()) {
    for (; begun < frames.chunk().size() && jobs.pending() < most_pending; ++begun) jobs.begin(read_next(frames));
    try {
      const Prepared prepared = jobs.take();
      const Clock::time_point begin = Clock::now();
      const MadeFrame made = prepared.finish();
      progress.done(number, made.files, prepared.milliseconds + milliseconds_since(begin), made.shows_nothing);
      empty.note(number, made.shows_nothing);
      unlabelled.note(number, made.lacks_labels);
    } catch (const std::exception& error) {
      if (ends_the_run(error)) throw;
      if (failures.count++ == 0) failures = {1, number, exit_code_of(error), error.what()};
      progress.failed(number, exit_code_of(error), error.what());
    }
  }
  progress.end();
  log_faults(command, empty, unlabelled);
  if (failures.count > 0)
    throw RunError(failures.code, "{} of {} frames failed; the first, frame {}: {}", with_thousands(failures.count),
                   with_thousands(frames.chunk().size()), failures.frame, failures.message);
  const Trajectory& trajectory = frames.trajectory();
  const bool reaches_end = std::ranges::any_of(
      frames.chunk(), [&](std::uint64_t number) { return frames.source(number) + 1 == trajectory.frame_count(); });
  if (!trajectory.cut_short().empty() && reaches_end)
    throw RunError(kExitIncomplete, "{}: {}; every whole frame asked for is done", trajectory.path(),
                   trajectory.cut_short());
}

}  // namespace meniscus
