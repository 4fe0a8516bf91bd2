// SPDX-License-Identifier: BSD-3-Clause
// Finds what is missing, has it made, and keeps the records.
#include "app/farm/worker.h"

#include <optional>
#include <set>

#include <fmt/format.h>

#include "app/build_version.h"
#include "app/farm/checksum.h"
#include "app/farm/frame_record.h"
#include "app/program_error.h"
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

class Worker {
 public:
  Worker(const Bundle& bundle, const Workplace& place, const Share& share, ProgressStyle progress)
      : bundle_(bundle), place_(place), share_(share), style_(progress), records_(place.folder, bundle) {}

  void run() {
    for (const std::string& name : share_.steps) run_step(*bundle_.step(name));
    if (!failures_.frames.empty())
      throw RunError(
          static_cast<ExitCode>(failures_.code),
          fmt::format("{} of {} frames failed; the first, frame {}: {}", with_thousands(failures_.frames.size()),
                      with_thousands(share_.frames.size()), failures_.first, failures_.message));
  }

 private:
  bool is_done(const std::string& step, std::uint64_t frame) const {
    const std::optional<FrameRecord> record = records_.read(step, frame);
    return record && record->done() && records_.fault(*record).empty();
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
    why = fmt::format("step {}: {}; do that step first", before, fault);
    return kExitInput;
  }

  void run_step(const Step& step) {
    std::vector<std::uint64_t> missing;
    for (const std::uint64_t frame : share_.frames) {
      const bool hopeless = failures_.frames.contains(frame);  // a step before failed just now
      if (!hopeless && (share_.force || !is_done(step.name, frame))) missing.push_back(frame);
    }
    RunProgress progress(style_, false, missing.size());
    std::erase_if(missing, [&](std::uint64_t frame) {
      std::string why;
      const int code = obstacle(step, frame, why);
      if (code == 0) return false;
      failures_.add(frame, code, why);
      progress.failed(frame, code, why);
      return true;
    });
    if (!missing.empty()) make_frames(bundle_, step, place_, missing, listener(step, progress));
    progress.end();
  }

  FrameListener listener(const Step& step, RunProgress& progress) {
    FrameListener listener;
    listener.done = [&](std::uint64_t frame, const std::vector<std::string>& files, double seconds) {
      records_.write(step.name, records_.measured(frame, files, seconds));
      progress.done(frame, files, 1000.0 * seconds);
    };
    listener.failed = [&](std::uint64_t frame, int code, const std::string& error) {
      FrameRecord record;
      record.frame = frame;
      record.exit_code = code;
      record.error = error;
      records_.write(step.name, record);
      failures_.add(frame, code, error);
      progress.failed(frame, code, error);
    };
    return listener;
  }

  const Bundle& bundle_;
  const Workplace& place_;
  const Share& share_;
  ProgressStyle style_;
  FrameRecords records_;
  Failures failures_;
};

}  // namespace

void check_inputs(const Bundle& bundle, const std::filesystem::path& folder, bool thorough) {
  for (const Input& input : bundle.inputs) {
    const std::string path = (folder / input.path).string();
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) throw InputError(path, 0, fmt::format("is missing ({}); make the bundle again", error.message()));
    const bool same =
        bytes == input.bytes && ((!thorough && bytes > kQuickToCheck) || sha256_of_file(path) == input.sha256);
    if (!same) throw InputError(path, 0, "is not what was bundled (size or SHA-256); make the bundle again");
  }
}

void work(const Bundle& bundle, const Workplace& place, const Share& share, ProgressStyle progress) {
  // Frames of one film must not come from two programs.
  if (bundle.program_version != build_version())
    throw InputError((place.folder / "bundle.json").string(), 0,
                     fmt::format("was made by meniscus {}, and this is {}; use one build on all machines",
                                 in_quotes(bundle.program_version), build_version()));
  check_inputs(bundle, place.folder, false);
  Worker(bundle, place, share, progress).run();
}

}  // namespace meniscus::farm
