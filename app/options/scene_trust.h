// SPDX-License-Identifier: BSD-3-Clause
// Scene files as the command line reads them, and the files that they name.
#pragma once

#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "core/scene/scene_json.h"

namespace meniscus {

/// The JSON of a scene file, or of the picture that carries it. Throws InputError.
std::string read_scene_text(const std::string& file);

/// Has no output replace what the command reads, or another output: neither by options nor by settings of a scene or of
/// --set. file: of the scene; empty: there is none. Throws as NamedFiles::check().
void guard_files(const CLI::App& command, const std::string& file, std::span<const SceneSetting> settings);

}  // namespace meniscus
