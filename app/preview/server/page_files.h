// SPDX-License-Identifier: BSD-3-Clause
// The files of the preview's page: the stage, which exported pages have too, and the preview's additions to it.
#pragma once

#include <optional>

#include "core/base/text.h"

namespace meniscus {

/// Returns the preview's own files, compiled into the program, by path: "program.js", ...
std::span<const TemplateFile> page_files();

/// Returns the file of this path as browsers get it: "" is the page itself, "page.css" and "stage.js" are the stage's
/// style and script. Returns nothing if there is no such file.
std::optional<std::string> served_file(std::string_view path);

/// Returns the media type of a path by its extension, such as "text/html; charset=utf-8", which is also that of "".
std::string_view content_type(std::string_view path);

}  // namespace meniscus
