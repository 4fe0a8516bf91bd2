// SPDX-License-Identifier: BSD-3-Clause
// The page's own files as join_page.cmake makes them of exporters/page/page: its text, its style, and its script.
#pragma once

#include <span>

#include "core/base/text.h"

namespace meniscus {

/// page.html, which has the digests of the others; marks: TITLE, STYLE, SCRIPT, DESCRIPTION, FACTS, LEGEND, STILL,
/// BYTES, DATA, VERSION. page.css and page.js, to the byte as the page has to have them.
std::span<const TemplateFile> page_templates();

}  // namespace meniscus
