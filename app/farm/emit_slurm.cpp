// SPDX-License-Identifier: BSD-3-Clause
// Writes scripts for Slurm: an array of tasks for each step, after all of the step before, however its tasks ended, and
// a job that verifies.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/farm/emit.h"
#include "app/farm/farm_templates.h"

namespace meniscus::farm {
namespace {

// `wait` ends early when a signal is trapped, so it is asked again. Code 9: stopped in good order; 137: killed, by the
// machine or by someone. Both go on where they were, but not for ever.
std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  return text;
}

// Three times what was measured, and ten minutes for a slow start; a site's default where nothing was measured.
std::string time_limit(const Bundle& bundle) {
  if (!bundle.chunking.seconds_per_frame) return {};
  const double frames =
      std::ceil(static_cast<double>(bundle.frames.size()) / static_cast<double>(bundle.chunking.count));
  return fmt::format("#SBATCH --time={:.0f}\n",
                     std::ceil(10.0 + 3.0 * frames * *bundle.chunking.seconds_per_frame / 60.0));
}

std::string resources(const Bundle& bundle) {
  const std::optional<std::uint64_t> memory = bundle.chunking.memory();
  return fmt::format("#SBATCH --cpus-per-task={}\n", bundle.chunking.cores) +
         (memory ? fmt::format("#SBATCH --mem={}M\n", *memory) : "");
}

}  // namespace

std::vector<EngineFile> emit_slurm(const Emission& emission) {
  const Bundle& bundle = emission.bundle;
  const std::string count = std::to_string(bundle.chunking.count);
  std::vector<EngineFile> files{{"slurm/verify.sbatch", std::string(farm_template("verify.sbatch")), false}};
  std::string jobs;
  for (const Step& step : bundle.steps) {
    const std::string more = (needs_gpu(step) ? "#SBATCH --gres=gpu:1\n" : "") + resources(bundle) + time_limit(bundle);
    files.push_back({fmt::format("slurm/{}.sbatch", step.name),
                     filled(farm_template("step.sbatch"), {{"STEP", step.name}, {"COUNT", count}, {"MORE", more}}),
                     false});
    jobs += filled(farm_template("submit_step.sh"),
                   {{"UPPER", upper(step.name)},
                    {"STEP", step.name},
                    {"DEPENDENCY", jobs.empty() ? "" : "--dependency=\"afterany:$job\" "}});
  }
  files.push_back({"submit.sh",
                   filled(farm_template("submit.sh"),
                          {{"FIRST", upper(bundle.steps.front().name)}, {"COUNT", count}, {"JOBS", jobs}}),
                   true});
  return files;
}

}  // namespace meniscus::farm
