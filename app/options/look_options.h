// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a picture looks: light, shade, lines, air.
#pragma once

#include <CLI/CLI.hpp>

#include "core/render/look.h"

namespace meniscus {

/// --light, --light-strength, --ambient-occlusion, --ambient-occlusion-radius, --silhouettes, --depth-cue. The look
/// must live as long as the command; its background is not touched.
void add_look_options(CLI::App& command, Look& look);

}  // namespace meniscus
