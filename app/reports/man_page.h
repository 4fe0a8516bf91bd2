// SPDX-License-Identifier: BSD-3-Clause
// Manual pages in the macros of man(7), made from the help.
#pragma once

#include <string>
#include <string_view>

#include "app/options/command_tree.h"

namespace meniscus {

/// What is in the margins of every page.
struct ManMargins {
  std::string date;     ///< 2026-11-22
  std::string version;  ///< "meniscus 0.1.0"
};

/// The page of a command, for section 1. `program` is what it belongs to, and `exit_codes` the text about them.
std::string command_man_page(const CommandEntry& command, const CommandEntry& program, std::string_view exit_codes,
                             const ManMargins& margins);

/// The page of a topic that belongs to no single command, for section 7.
std::string topic_man_page(std::string_view name, std::string_view summary, std::string_view text,
                           const ManMargins& margins);

/// The name of a page without its section: "meniscus-export-povray".
std::string man_page_name(const CommandEntry& command);
std::string man_page_name(std::string_view topic);

}  // namespace meniscus
