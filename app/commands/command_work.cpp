// SPDX-License-Identifier: BSD-3-Clause
// `meniscus work`: makes the missing frames of a bundle, for a person or for any engine.
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <unordered_set>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/farm/child_process.h"
#include "app/farm/claims.h"
#include "app/farm/worker.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "core/base/text.h"
#include "app/farm/check_bundle.h"
#include "core/trajectory/frame_list.h"
#include "app/options/property_options.h"

namespace meniscus {
namespace {

struct WorkCommand {
  std::string folder, step, frames, chunk;
  bool force = false, require_gpu = false;
  double lease = farm::kDefaultLease;
  std::optional<std::uint64_t> tries;
  std::string device;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::automatic;
};

struct Chunk {
  std::uint64_t number = 0, count = 0;
};

/// K/N, 1 <= K <= N.
Chunk parse_chunk(const std::string& text) {
  std::uint64_t k = 0, n = 0;
  const char* const end = text.data() + text.size();
  const auto [slash, first_error] = std::from_chars(text.data(), end, k);
  const bool has_slash = first_error == std::errc() && slash != end && *slash == '/';
  const auto [rest, second_error] = has_slash ? std::from_chars(slash + 1, end, n) : std::from_chars(end, end, n);
  if (!has_slash || second_error != std::errc() || rest != end || k < 1 || k > n)
    throw UsageError(fmt::format("--chunk is {}; it must be K/N with K from 1 to N, such as 3/10", in_quotes(text)));
  return {k, n};
}

/// Of the run those that the list has: of every tenth frame, 0-30 means four.
std::vector<std::uint64_t> listed_frames(const farm::Bundle& bundle, const std::string& text) {
  const std::uint64_t largest = *std::ranges::max_element(bundle.frames);
  const std::vector<std::uint64_t> list = parse_frame_list("--frames", text, largest + 1);
  const std::unordered_set<std::uint64_t> wanted(list.begin(), list.end());
  std::vector<std::uint64_t> frames;
  std::ranges::copy_if(bundle.frames, std::back_inserter(frames), [&](std::uint64_t n) { return wanted.contains(n); });
  if (frames.empty())
    throw UsageError(fmt::format("--frames {}: none of them is in this bundle; it has {}", in_quotes(text),
                                 frame_list_text(bundle.frames)));
  return frames;
}

farm::Assignment assignment_of(const WorkCommand& command, const farm::Bundle& bundle) {
  farm::Assignment assignment;
  assignment.force = command.force;
  assignment.alone = !command.chunk.empty();
  assignment.lease_seconds = command.lease;
  assignment.tries = bundle.tries;
  if (command.tries) assignment.tries.most = *command.tries;
  std::string names;
  for (const farm::Step& step : bundle.steps) {
    names += (names.empty() ? "" : ", ") + step.name;
    if (command.step.empty() || command.step == step.name) assignment.steps.push_back(step.name);
  }
  if (assignment.steps.empty())
    throw UsageError(fmt::format("--step {} is not a step of this bundle: {}", in_quotes(command.step), names));
  const std::optional<Chunk> chunk = command.chunk.empty() ? std::nullopt : std::optional(parse_chunk(command.chunk));
  // Workers of neighbouring shares on a machine of several GPUs take one each.
  if (chunk) ::setenv(kWorkerVariable, std::to_string(chunk->number - 1).c_str(), 0);
  assignment.frames = chunk                     ? farm::chunk_of(bundle, chunk->number, chunk->count)
                      : !command.frames.empty() ? listed_frames(bundle, command.frames)
                                                : bundle.frames;
  return assignment;
}

farm::Workplace workplace_of(const WorkCommand& command) {
  farm::Workplace place;
  place.folder = std::filesystem::absolute(command.folder);
  place.threads = command.threads;
  if (!command.device.empty()) place.device_options = {"--device", command.device};
  if (command.require_gpu) place.device_options.emplace_back("--require-gpu");
  return place;
}

void run(const WorkCommand& command) {
  const farm::Bundle bundle = farm::read_bundle(command.folder);
  const farm::Assignment assignment = assignment_of(command, bundle);
  const farm::Workplace place = workplace_of(command);
  // Software GL takes as many threads as the machine has cores unless set.
  if (command.threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(command.threads).c_str(), 0);
  const StopHandler handler(
      [&] {
        farm::stop_children();
        farm::give_back_all_claims();
        farm::remove_own_leftovers(place.folder);
      },
      kExitStopped);
  farm::work(bundle, place, assignment, command.progress);
}

}  // namespace

void add_work(CLI::App& command) {
  describe(command,
           "  meniscus work film                                all that is missing\n"
           "  meniscus work film --step render --chunk 3/10     the third of ten shares of one step\n"
           "  meniscus work film --frames 40-49 --force         these once more",
           "A frame whose files exist with the right checksums is not made again. So the same command continues after "
           "any\ninterruption, even kill -9, and any number of workers can share a bundle: each frame is made by one "
           "of them.\nWhen it is stopped (SIGTERM, SIGUSR1, Ctrl-C) it leaves complete files only and ends with exit "
           "code 9. If a\nframe fails, the others are still made; the exit code is that of the failed frame.");
  auto state = std::make_shared<WorkCommand>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  PropertyOptions options(command);
  options.add("work.step", state->step);
  CLI::Option* const frames = options.add("work.frames", state->frames);
  options.add("work.chunk", state->chunk)->excludes(frames);
  options.add("work.force", state->force);
  options.add("work.tries", state->tries);
  options.add("work.lease", state->lease);
  using enum ProgressStyle;
  options.add_word("frames.progress", state->progress, {automatic, bar, plain, json, openjd, none});
  options.add("work.device", state->device);
  options.add("work.require_gpu", state->require_gpu);
  options.add("work.threads", state->threads);
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
