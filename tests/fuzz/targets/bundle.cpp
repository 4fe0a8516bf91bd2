// SPDX-License-Identifier: BSD-3-Clause
// Bundles of a farm: bundle.json from anywhere, and what a worker would take from it.
#include <algorithm>
#include <cmath>

#include "app/farm/bundle.h"
#include "core/base/error.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void require_inside(const std::string& text) {
  const std::filesystem::path path(text);
  require(path.is_relative() && std::ranges::find(path, "..") == path.end(), "paths stay in the bundle");
}

void check(const farm::Bundle& bundle) {
  require(bundle.command.size() >= 2, "there is a command");
  require(!bundle.frames.empty(), "there are frames");
  require(!bundle.steps().empty(), "there is work");
  if (bundle.film) {
    require_inside(bundle.film->file);
    require(std::isfinite(bundle.film->frames_per_second) && bundle.film->frames_per_second > 0.0,
            "a film has a speed");
  }
  require(bundle.width > 0 && bundle.height > 0, "pictures have a size");
  const std::uint64_t tasks = bundle.chunking.count;
  require(tasks >= 1 && tasks <= bundle.frames.size(), "there are tasks, and not more than frames");
  std::vector<std::uint64_t> frames;
  for (std::uint64_t k = 1; k <= tasks; ++k) {
    const std::vector<std::uint64_t> chunk = farm::chunk_of(bundle, k, tasks);
    frames.insert(frames.end(), chunk.begin(), chunk.end());
  }
  require(frames == bundle.frames, "the tasks together make the run");
}

void run_bundle(std::string_view bytes) {
  static const ScratchFile file("bundle.json");
  file.write(bytes);
  try {
    const farm::Bundle bundle = farm::read_bundle(file.folder());
    check(bundle);
    file.write(farm::bundle_json(bundle));
    const farm::Bundle again = farm::read_bundle(file.folder());
    require(farm::same_but_for_measurement(bundle, again), "a bundle written is read as it was");
  } catch (const InputError& error) {
    require_clear(error);
  }
}

const Registration registered_bundle{"bundle", run_bundle};

}  // namespace
}  // namespace meniscus::fuzz
