// SPDX-License-Identifier: BSD-3-Clause
// The files of the page, compiled into the program.
#pragma once

#include <span>
#include <string_view>

namespace meniscus {

struct PageFile {
  std::string_view path;  ///< "index.html", "page.js", ...
  std::string_view content;
};

/// All of them, by path.
std::span<const PageFile> page_files();

/// "text/html; charset=utf-8", ... by the extension of a path.
std::string_view content_type(std::string_view path);

}  // namespace meniscus
