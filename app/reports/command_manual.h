// SPDX-License-Identifier: BSD-3-Clause
// Writes manual pages in the macros of man(7) from the help.
#pragma once

#include <string>
#include <string_view>

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

}  // namespace meniscus
