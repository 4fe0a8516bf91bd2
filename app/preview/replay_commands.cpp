// SPDX-License-Identifier: BSD-3-Clause
// Carries out what was recorded.
#include "app/preview/command_log.h"
#include "app/preview/session.h"

namespace meniscus {

void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies) {
  for (const auto& [line, command] : commands) {
    if (session.wants_to_quit()) return;
    print_reply(path, line, session.apply(command), replies);
  }
}

}  // namespace meniscus
