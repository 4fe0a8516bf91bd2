// SPDX-License-Identifier: BSD-3-Clause
// Which files a scene may name, because it may come from anyone, and which its text can name.
#pragma once

#include <string>
#include <vector>

#include "core/properties/properties.h"
#include "core/scene/scene.h"

namespace meniscus {

/// What someone who uses a scene has said of files. Unless it is trusted as a whole a scene names no files outside of
/// its folder and the working folder but those that are typed or named before, and writes to none but a new one beside
/// it.
struct SceneTrust {
  std::string file{};                ///< of the scene
  std::vector<std::string> typed{};  ///< words of the command line
  std::vector<std::string> named{};  ///< of an earlier one
  bool is_whole = false;             ///< --trust-scene
  bool replaces = false;             ///< --force
  std::string advice{};              ///< how this door lets a scene name a file outside: the end of a sentence

  /// A path of the scene as seen from here: one that is read is looked for in the scene's folder, then in the working
  /// folder. Throws InputError for one that it may not name. place: in the scene.
  std::string path(const Property& property, const std::string& text, const std::string& place) const;

 private:
  bool has(const std::string& path) const;
};

/// A sentence about a value that is not UTF-8, such as the name of a file, which would be another in the text of the
/// scene; empty: there is none.
std::string scene_fault(const Scene& scene);

}  // namespace meniscus
