// SPDX-License-Identifier: BSD-3-Clause
// Slurm: an array of tasks for each step, each task behind the same task of the step before, and a job that verifies.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/farm/emit.h"

namespace meniscus::farm {
namespace {

constexpr const char* kSubmit = R"sh(#!/bin/bash
# Submits the frames of this folder to Slurm; prints the job of each step. Options of sbatch may follow, for all jobs
# (--partition, --account, --time, ...); those of one step stand in MENISCUS_@FIRST@_OPTIONS and so on, blanks between.
# MENISCUS is the program, if it is not `meniscus` in PATH. Submit again to go on after a failure: what is done stays.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
mkdir -p logs
export MENISCUS="${MENISCUS:-meniscus}"
largest=$(scontrol show config | awk '$1 == "MaxArraySize" {print $3}')
if [ "${largest:-1001}" -le @COUNT@ ]; then
  echo "this Slurm takes arrays of $((largest - 1)) tasks, the bundle has @COUNT@: bundle with larger chunks" >&2
  exit 2
fi
@JOBS@job=$(sbatch --parsable --dependency="afterok:$job" --kill-on-invalid-dep=yes "$@" slurm/verify.sbatch)
echo "verify $job"
)sh";

constexpr const char* kStepJob = R"sh(read -r -a options <<<"${MENISCUS_@UPPER@_OPTIONS:-}"
job=$(sbatch --parsable @DEPENDENCY@"$@" "${options[@]}" slurm/@STEP@.sbatch)
echo "@STEP@ $job"
)sh";

// `wait` ends early when a signal is trapped, so it is asked again. Code 9: stopped in good order; 137: killed, by the
// machine or by somebody. Both go on where they were, but not for ever.
constexpr const char* kStepScript = R"sh(#!/bin/bash
#SBATCH --job-name=meniscus-@STEP@
#SBATCH --array=1-@COUNT@
#SBATCH --output=logs/@STEP@-%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=B:USR1@60
@MORE@
threads=${SLURM_CPUS_PER_TASK:-1}
export LP_NUM_THREADS=$threads
"${MENISCUS:-meniscus}" work . --step @STEP@ --chunk "$SLURM_ARRAY_TASK_ID/@COUNT@" --threads "$threads" --progress plain &
worker=$!
trap 'kill -USR1 "$worker"' USR1
trap 'kill -TERM "$worker"' TERM
wait "$worker"; code=$?
while kill -0 "$worker" 2>/dev/null; do wait "$worker"; code=$?; done
if { [ "$code" -eq 9 ] || [ "$code" -eq 137 ]; } && [ "${SLURM_RESTART_COUNT:-0}" -lt 10 ]; then
  echo "task $SLURM_ARRAY_TASK_ID was stopped (code $code); back into the queue"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60
fi
exit "$code"
)sh";

constexpr const char* kVerifyScript = R"sh(#!/bin/bash
#SBATCH --job-name=meniscus-verify
#SBATCH --output=logs/verify.log
#SBATCH --open-mode=append

exec "${MENISCUS:-meniscus}" farm verify .
)sh";

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
  std::vector<EngineFile> files{{"slurm/verify.sbatch", kVerifyScript, false}};
  std::string jobs;
  for (const Step& step : bundle.steps) {
    const std::string more = (needs_gpu(step) ? "#SBATCH --gres=gpu:1\n" : "") + resources(bundle) + time_limit(bundle);
    files.push_back({fmt::format("slurm/{}.sbatch", step.name),
                     filled(kStepScript, {{"STEP", step.name}, {"COUNT", count}, {"MORE", more}}), false});
    jobs += filled(kStepJob,
                   {{"UPPER", upper(step.name)},
                    {"STEP", step.name},
                    {"DEPENDENCY", jobs.empty() ? "" : "--dependency=\"aftercorr:$job\" --kill-on-invalid-dep=yes "}});
  }
  files.push_back({"submit.sh",
                   filled(kSubmit, {{"FIRST", upper(bundle.steps.front().name)}, {"COUNT", count}, {"JOBS", jobs}}),
                   true});
  return files;
}

}  // namespace meniscus::farm
