// SPDX-License-Identifier: BSD-3-Clause
// Writes a Makefile, for one machine without any queue: make is the engine.
#include <fmt/format.h>

#include "app/farm/emit.h"
#include "app/farm/farm_templates.h"

namespace meniscus::farm {
std::vector<EngineFile> emit_make(const Emission& emission) {
  const Bundle& bundle = emission.bundle;
  std::string chunks, rules, phony, before;
  for (std::uint64_t k = 1; k <= bundle.chunking.count; ++k) chunks += fmt::format("{}{}", k == 1 ? "" : " ", k);
  for (const Step& step : bundle.steps) {
    const std::string all = fmt::format("$(addprefix {}-,$(CHUNKS))", step.name);
    phony += (phony.empty() ? "" : " ") + all;
    // A frame that fails does not keep the next step from the others of its chunk.
    const bool is_last = &step == &bundle.steps.back();
    rules +=
        fmt::format("{}: {}-%:{}\n\t{}$(WORK) --step {} --chunk $*/{}\n\n", all, step.name,
                    before.empty() ? "" : " " + before + "-%", is_last ? "" : "-", step.name, bundle.chunking.count);
    before = step.name;
  }
  const std::optional<std::uint64_t> memory = bundle.chunking.memory();
  const std::string text =
      filled(farm_template("Makefile"),
             {{"CHUNKS", chunks},
              {"RULES", rules},
              {"LAST", before},
              {"PHONY", phony},
              {"MEMORY", memory ? fmt::format("\n# Each task needs about {} MiB of memory.", *memory) : ""}});
  return {{"Makefile", text, false}};
}

}  // namespace meniscus::farm
