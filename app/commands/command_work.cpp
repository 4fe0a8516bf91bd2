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
#include "app/farm/worker.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

struct WorkCommand {
  std::string folder, step, frames, chunk;
  bool force = false, require_gpu = false;
  std::string device;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::automatic;
};

struct Chunk {
  std::uint64_t number = 0, count = 0;
};

/// Parses K/N, 1 <= K <= N.
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

/// Returns the frames of the run that are in the list: in a run of every tenth frame, 0-30 means four frames.
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

farm::Share share_of(const WorkCommand& command, const farm::Bundle& bundle) {
  farm::Share share;
  share.force = command.force;
  share.is_whole_run = command.chunk.empty() && command.frames.empty();
  for (const farm::Step step : bundle.steps())
    if (command.step.empty() || command.step == farm::word_of(step)) share.steps.push_back(step);
  if (share.steps.empty())
    throw UsageError(fmt::format("--step {} is not a step of this bundle", in_quotes(command.step)));
  const std::optional<Chunk> chunk = command.chunk.empty() ? std::nullopt : std::optional(parse_chunk(command.chunk));
  // Workers of neighbouring chunks on a machine of several GPUs take one each.
  if (chunk) ::setenv(kWorkerVariable, std::to_string(chunk->number - 1).c_str(), 0);
  share.frames = chunk                     ? farm::chunk_of(bundle, chunk->number, chunk->count)
                 : !command.frames.empty() ? listed_frames(bundle, command.frames)
                                           : bundle.frames;
  return share;
}

farm::Workplace workplace_of(const WorkCommand& command) {
  farm::Workplace place;
  place.folder = std::filesystem::absolute(command.folder);
  place.threads = command.threads;
  if (!command.device.empty()) place.device = {"--device", command.device};
  if (command.require_gpu) place.device.emplace_back("--require-gpu");
  return place;
}

void run(const WorkCommand& command) {
  const farm::Bundle bundle = farm::read_bundle(command.folder);
  const farm::Share share = share_of(command, bundle);
  const farm::Workplace place = workplace_of(command);
  // Software GL takes as many threads as the machine has cores unless this is set.
  if (command.threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(command.threads).c_str(), 0);
  const StopHandler handler([] { stop_children(); }, kExitStopped);
  farm::work(bundle, place, share, command.progress);
}

}  // namespace

void add_work(CLI::App& command) {
  describe(
      command,
      "  meniscus work film                                all that is missing\n"
      "  meniscus work film --step render --chunk 3/10     the third of ten shares of one step\n"
      "  meniscus work film --frames 40-49 --force         these once more",
      "A frame that is there is not made again. So the same command continues after any interruption, even kill -9, "
      "and\nany number of workers can share a bundle without knowing of each other; they make a few frames twice, "
      "with the\nsame bytes. When it is stopped (SIGTERM, SIGUSR1, Ctrl-C) it leaves complete files only and ends "
      "with exit code 9.\nIf a frame fails, the others are still made; the exit code is that of the failed frame.");
  auto state = std::make_shared<WorkCommand>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  PropertyOptions options(command);
  options.add("work.step", state->step);
  CLI::Option* const frames = options.add("work.frames", state->frames);
  options.add("work.chunk", state->chunk)->excludes(frames);
  options.add("work.force", state->force);
  using enum ProgressStyle;
  options.add_word("frames.progress", state->progress, {automatic, bar, plain, json, openjd, none});
  options.add("work.device", state->device);
  options.add("work.require_gpu", state->require_gpu);
  options.add("work.threads", state->threads);
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
