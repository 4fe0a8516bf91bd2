// SPDX-License-Identifier: BSD-3-Clause
// Which files a scene may name: it may come from anybody.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/properties/properties.h"
#include "core/scene/scene_json.h"

namespace meniscus {

/// What somebody who uses a scene has said of files. Without --trust-scene a scene names no files outside of its folder
/// but those that are typed or named before, and writes to none but a new one beside it.
struct SceneTrust {
  std::string file;                ///< of the scene
  std::vector<std::string> typed;  ///< words of the command line
  std::vector<std::string> named;  ///< of an earlier one
  bool is_whole = false;           ///< --trust-scene
  bool replaces = false;           ///< --force

  /// A path of the scene as seen from here. Throws InputError for one that it may not name. place: in the scene.
  std::string path(const Property& property, const std::string& text, const std::string& place) const;

 private:
  bool has(const std::string& path) const;
};

/// The JSON of a scene file, or of the picture that carries it. Throws InputError.
std::string read_scene_text(const std::string& file);

/// file: of the scene; empty: there is none. Files that the scene names are inputs that no output replaces; outputs
/// that it names are not those of options. Throws UsageError.
void guard_scene_files(const CLI::App& command, const std::string& file, std::span<const SceneSetting> settings);

}  // namespace meniscus
