// SPDX-License-Identifier: BSD-3-Clause
// `meniscus work`: makes the missing frames of a bundle, for a person or for any engine.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "app/commands/command_table.h"
#include "app/farm/worker.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

struct WorkCommand {
  std::string folder, frames, chunk, device;
  std::optional<farm::Step> step;
  bool require_gpu = false;
  farm::Order order;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// Returns the frames of K/N, 1 <= K <= N.
std::vector<std::uint64_t> frames_of_chunk(const farm::Bundle& bundle, const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  std::int64_t k = 0, n = 0;
  if (!parse_whole_number(text.substr(0, slash), k) || slash == text.size() ||
      !parse_whole_number(text.substr(slash + 1), n) || k < 1 || k > n)
    throw UsageError(fmt::format("--chunk is {}; it must be K/N with K from 1 to N, such as 3/10", in_quotes(text)));
  // Workers of neighbouring shares on a machine of several GPUs take one each.
  ::setenv(kWorkerVariable, std::to_string(k - 1).c_str(), 0);
  return farm::chunk_of(bundle, static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(n));
}

/// Returns those frames of the run that are in the list: 0-30 means four frames of a run of every tenth.
std::vector<std::uint64_t> listed_frames(const farm::Bundle& bundle, const std::string& text) {
  const std::uint64_t largest = *std::ranges::max_element(bundle.frames);
  const std::vector<std::uint64_t> list = parse_frame_list("--frames", text, largest + 1);
  const std::set<std::uint64_t> wanted(list.begin(), list.end());
  std::vector<std::uint64_t> frames;
  std::ranges::copy_if(bundle.frames, std::back_inserter(frames), [&](std::uint64_t n) { return wanted.contains(n); });
  if (frames.empty())
    throw UsageError(fmt::format("--frames {}: none of them is in this bundle; it has {}", in_quotes(text),
                                 frame_list_text(bundle.frames)));
  return frames;
}

void run(WorkCommand command) {
  const farm::Bundle bundle = farm::read_bundle(command.folder);
  farm::Order& order = command.order;
  order.folder = std::filesystem::absolute(command.folder);
  for (const farm::Step step : bundle.steps())
    if (!command.step || command.step == step) order.steps.push_back(step);
  if (order.steps.empty()) throw UsageError("--step: this bundle has no such step; leave it out");
  order.is_whole_run = command.chunk.empty() && command.frames.empty();
  order.frames = !command.chunk.empty()    ? frames_of_chunk(bundle, command.chunk)
                 : !command.frames.empty() ? listed_frames(bundle, command.frames)
                                           : bundle.frames;
  if (!command.device.empty()) order.device = {"--device", command.device};
  if (command.require_gpu) order.device.emplace_back("--require-gpu");
  // Software GL takes as many threads as the machine has cores unless this is set.
  if (order.threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(order.threads).c_str(), 0);
  const StopHandler handler([] { stop_children(); }, kExitStopped);
  farm::work(bundle, order, command.progress);
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
  options.add_word("work.step", state->step, {farm::Step::surface, farm::Step::render});
  CLI::Option* const frames = options.add("work.frames", state->frames);
  options.add("work.chunk", state->chunk)->excludes(frames);
  options.add("work.force", state->order.force);
  using enum ProgressStyle;
  options.add_word("frames.progress", state->progress, {automatic, bar, plain, json, openjd, none});
  options.add("work.device", state->device);
  options.add("surface.require_gpu", state->require_gpu);
  options.add("surface.threads", state->order.threads);
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
