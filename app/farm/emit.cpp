// SPDX-License-Identifier: BSD-3-Clause
// The table of engines, and the code that emitters share.
#include "app/farm/emit.h"

#include <algorithm>

namespace meniscus::farm {

const std::vector<Engine>& engines() {
  static const std::vector<Engine> table{
      {"make", emit_make, nullptr, "make -C @DIR@ -j2"},
      {"slurm", emit_slurm, nullptr, "@DIR@/submit.sh"},
      {"openjd", emit_openjd, nullptr, "deadline bundle submit @DIR@, or openjd run @DIR@/template.json"},
      {"flamenco", emit_flamenco, nullptr,
       "once: @DIR@/meniscus_film.js into the manager's scripts folder; then POST @DIR@/flamenco_job.json"},
      {"opencue", emit_opencue, "its commands have no working directory",
       "launch @DIR@/opencue.xml, by pycue's launchSpec"},
  };
  return table;
}

bool needs_gpu(const Step& step) {
  return step.maker == Maker::meniscus && std::ranges::find(step.arguments, "--require-gpu") != step.arguments.end();
}

}  // namespace meniscus::farm
