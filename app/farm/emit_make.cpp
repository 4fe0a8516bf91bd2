// SPDX-License-Identifier: BSD-3-Clause
// A Makefile, for one machine without any queue: make is the engine.
#include <fmt/format.h>

#include "app/farm/emit.h"

namespace meniscus::farm {
namespace {

constexpr const char* kTemplate =
    R"make(# The frames of this folder on one machine: make -j2 (-k goes on with other chunks after one that failed).
# MENISCUS is the program; THREADS what each task may use: of the machine's cores as many as -j leaves to one.@MEMORY@
MENISCUS ?= meniscus
JOBS = $(or $(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS))),$(if $(filter -j,$(MAKEFLAGS)),$(shell nproc),1))
THREADS ?= $(shell threads=$$(($$(nproc) / $(JOBS))); echo $$((threads > 0 ? threads : 1)))
WORK = $(MENISCUS) work . --progress plain --threads $(THREADS)
CHUNKS := @CHUNKS@

all: verify

@RULES@verify: $(addprefix @LAST@-,$(CHUNKS))
	$(MENISCUS) farm verify .

status:
	$(MENISCUS) farm status .

.PHONY: all verify status @PHONY@
)make";

}  // namespace

std::vector<EngineFile> emit_make(const Emission& emission) {
  const Bundle& bundle = emission.bundle;
  std::string chunks, rules, phony, before;
  for (std::uint64_t k = 1; k <= bundle.chunking.count; ++k) chunks += fmt::format("{}{}", k == 1 ? "" : " ", k);
  for (const Step& step : bundle.steps) {
    const std::string all = fmt::format("$(addprefix {}-,$(CHUNKS))", step.name);
    phony += (phony.empty() ? "" : " ") + all;
    rules += fmt::format("{}: {}-%:{}\n\t$(WORK) --step {} --chunk $*/{}\n\n", all, step.name,
                         before.empty() ? "" : " " + before + "-%", step.name, bundle.chunking.count);
    before = step.name;
  }
  const std::optional<std::uint64_t> memory = bundle.chunking.memory();
  const std::string text = filled(
      kTemplate, {{"CHUNKS", chunks},
                  {"RULES", rules},
                  {"LAST", before},
                  {"PHONY", phony},
                  {"MEMORY", memory ? fmt::format("\n# Each task needs about {} MiB of memory.", *memory) : ""}});
  return {{"Makefile", text, false}};
}

}  // namespace meniscus::farm
