// SPDX-License-Identifier: BSD-3-Clause
// The page's own files, exporters/page/page: its text, its style, and its script in parts.
#pragma once

#include <span>

#include "core/base/text.h"

namespace meniscus {

/// page.html; marks: TITLE, STYLE, STYLE_HASH, SCRIPT, SCRIPT_HASH, DESCRIPTION, FACTS, LEGEND, STILL, BYTES, DATA,
/// VERSION. page.css. The script: data.js, camera.js, caster.js, layers.js, views.js, frames.js, png.js, controls.js,
/// in this order.
std::span<const TemplateFile> page_templates();

}  // namespace meniscus
