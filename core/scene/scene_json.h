// SPDX-License-Identifier: BSD-3-Clause
// Scenes as JSON, both ways: {"meniscus_scene": 1, SECTION: {KEY: VALUE, ...}, ..., "objects": [...]}.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/properties/properties.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A value that a scene file sets.
struct SceneSetting {
  const Property* property = nullptr;
  std::vector<std::string> texts;  ///< as set_value takes them; paths as the file has them
  std::string place;               ///< in the file, for messages: "objects[0].clip"
};

/// The settings of a scene, in the order of the table of properties. file: its name, for messages. Throws InputError
/// for what is not a scene, has no such key, or has values of another type; what values mean is looked at when they are
/// set.
std::vector<SceneSetting> parse_scene(std::string_view json, const std::string& file);

/// The scene as a file has it, ending with a newline: what differs from Scene{}. folder: from which paths are seen;
/// empty: files by their names alone, and no output. added: the files that were superposed when the scene was drawn,
/// with atoms and RMSD as "superposed", which parse_scene passes over.
std::string scene_text(const Scene& scene, const std::string& folder, std::span<const AddedFile> added = {});

}  // namespace meniscus
