// SPDX-License-Identifier: BSD-3-Clause
// The stage's files as join_page.cmake makes them of exporters/page/page: text, style, script, and the policy of a page
// that is one file.
#pragma once

#include "core/base/text.h"

namespace meniscus {

/// Returns page.html with the marks POLICY, TITLE, STYLE, SCRIPT, DESCRIPTION, FACTS, LEGEND, STILL, BYTES, DATA and
/// VERSION; policy.html, which holds the digests of style and script; page.css, and the script's halves first.js and
/// second.js, to the byte as a page has to have them.
std::span<const TemplateFile> page_templates();

}  // namespace meniscus
