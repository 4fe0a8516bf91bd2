// SPDX-License-Identifier: BSD-3-Clause
// The stage's files that join_page.cmake makes: text, style, script, and the policy of a page of one file.
#pragma once

#include "core/base/text.h"

namespace meniscus {

/// Returns page.html with the marks POLICY, TITLE, STYLE, SCRIPT, DESCRIPTION, FACTS, LEGEND, STILL, BYTES, DATA and
/// VERSION; policy.html, with the digests of style and script; page.css, and the script's halves first.js and
/// second.js, all of which pages must contain unchanged.
std::span<const TemplateFile> page_templates();

}  // namespace meniscus
