// SPDX-License-Identifier: BSD-3-Clause
// Manual pages and completion scripts of commands, and the pages of the manual, which are compiled into the program.
#pragma once

#include "app/options/command_tree.h"

namespace meniscus {

/// The margins of every page.
struct ManMargins {
  std::string date;     ///< 2026-11-22
  std::string version;  ///< "meniscus 0.1.0"
};

/// Returns the page of a command of a program, for section 1. exit_codes: the text about them.
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

/// A page of the manual.
struct ManualPage {
  std::string_view path;  ///< below docs: "how-to/figures.md"
  std::string_view markdown;

  /// Returns the name by which users request the page: "figures".
  constexpr std::string_view name() const {
    const std::string_view file = path.substr(path.rfind('/') + 1);
    return file.substr(0, file.rfind('.'));
  }
  /// Returns the page's first heading.
  constexpr std::string_view title() const {
    const std::string_view line = markdown.substr(0, markdown.find('\n'));
    return line.substr(line.find_first_not_of("# ") == line.npos ? line.size() : line.find_first_not_of("# "));
  }
};

/// Returns all pages, by path.
std::span<const ManualPage> manual_pages();

}  // namespace meniscus
