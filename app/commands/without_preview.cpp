// SPDX-License-Identifier: BSD-3-Clause
// Refuses `meniscus preview` in builds without window and page.
#include "app/commands/commands.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"

namespace meniscus {

void add_preview(CLI::App& command) {
  describe(command, "", "This build has neither window nor page; configure it with -DMENISCUS_PREVIEW=ON.");
  command.allow_extras();
  command.callback([] {
    throw UsageError("this build has no preview; configure it with -DMENISCUS_PREVIEW=ON, or use meniscus render");
  });
}

}  // namespace meniscus
