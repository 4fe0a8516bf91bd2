// SPDX-License-Identifier: BSD-3-Clause
// Manual pages and completion scripts of commands.
#pragma once

#include "app/options/command_tree.h"

namespace meniscus {

/// The margins of every page.
struct ManMargins {
  std::string date;     ///< 2026-11-22
  std::string version;  ///< "meniscus 0.1.0"
};

/// Returns the page of a command, for section 1. `program` is the command's program, and `exit_codes` the text about
/// them.
std::string command_man_page(const CommandEntry& command, const CommandEntry& program, std::string_view exit_codes,
                             const ManMargins& margins);

/// Returns the page of a topic that belongs to no single command, for section 7.
std::string topic_man_page(std::string_view name, std::string_view summary, std::string_view text,
                           const ManMargins& margins);

/// Returns the name of a page without its section: "meniscus-export-povray".
std::string man_page_name(const CommandEntry& command);
std::string man_page_name(std::string_view topic);

/// Returns a script to be sourced by bash, or put into a folder of bash-completion under the program's name.
std::string bash_completion(const CommandEntry& program);

/// Returns a script to be put into a folder of zsh's fpath as _NAME.
std::string zsh_completion(const CommandEntry& program);

/// Returns a script to be put into a folder of fish's completions as NAME.fish.
std::string fish_completion(const CommandEntry& program);

}  // namespace meniscus
