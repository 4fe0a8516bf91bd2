// SPDX-License-Identifier: BSD-3-Clause
// The files that a scene may name, since it may come from anyone, and the files that its text can name.
#pragma once

#include "core/properties/properties.h"
#include "core/scene/scene.h"

namespace meniscus {

/// The files that the user of a scene allows it to name. Unless the scene is trusted as a whole, it names no files
/// outside of its folder and the working folder except files that are typed or named before, and it writes only to new
/// files next to itself.
struct SceneTrust {
  std::string file{};                ///< the scene's file
  std::vector<std::string> typed{};  ///< words of the command line
  std::vector<std::string> named{};  ///< words of an earlier command line
  bool is_whole = false;             ///< --trust-scene
  bool replaces = false;             ///< --force
  std::string advice{};              ///< how the user can allow a file outside of the folder: the end of a sentence

  /// Returns a path of the scene relative to the working folder. A path to read is searched in the scene's folder, then
  /// in the working folder, then among the words of the earlier command line. place: the place of the path in the
  /// scene. Throws InputError for a path that the scene may not name.
  std::string path(const Property& property, const std::string& text, const std::string& place) const;

 private:
  bool has(const std::string& path) const;
};

/// Returns a sentence about a value that is not UTF-8, such as a file name, because the text of the scene would change
/// it; empty if there is none.
std::string scene_fault(const Scene& scene);

}  // namespace meniscus
