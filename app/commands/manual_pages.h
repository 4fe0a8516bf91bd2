// SPDX-License-Identifier: BSD-3-Clause
// The pages of the manual, compiled into the program.
#pragma once

#include <span>
#include <string_view>

namespace meniscus {

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
