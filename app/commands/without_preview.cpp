// SPDX-License-Identifier: BSD-3-Clause
// Reports that there is no `meniscus preview`, in builds without its page.
#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/preview/server/serve.h"
#include "app/process/program_main.h"

namespace meniscus {

void add_preview(CLI::App& command) {
  describe(command, "", "This build has no preview; those from source have (meniscus help install).");
  command.allow_extras();
  command.callback([] {
    throw UsageError(
        "this build has no preview; build Meniscus from source (meniscus help install), or use meniscus render");
  });
}

std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t>, glm::ivec2, bool) { return {}; }

}  // namespace meniscus
