// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a picture looks: light, shade, lines, air.
#pragma once

#include <CLI/CLI.hpp>

#include "core/camera/view_request.h"
#include "core/render/look_presets.h"

namespace meniscus {

/// --preset, --light, --light-strength, --ambient, --roughness, --specular, --shininess, --ambient-occlusion,
/// --ambient-occlusion-radius, --silhouettes, --outer-lines, --inner-lines, --part-lines, --depth-cue, --linear-alpha.
/// Both requests must live as long as the command. picture: in whose pixels lines are; its options were declared
/// before.
void add_look_options(CLI::App& command, LookRequest& look, ViewRequest& picture);

}  // namespace meniscus
