// SPDX-License-Identifier: BSD-3-Clause
// The keys of scene files, and the option that each of them is.
#pragma once

#include <span>
#include <string_view>

namespace meniscus {

/// What a key's value looks like, in JSON and as words of a command line.
enum class SceneValue {
  text,          ///< a text or a number
  flag,          ///< true; false is the same as nothing
  negated,       ///< false gives the option, true is the same as nothing
  list,          ///< a text or a number, or a list of them: the option again and again
  path,          ///< a file, seen from the scene's folder
  paths,         ///< one, or a list of them
  text_or_flag,  ///< true gives the option without a value
  camera         ///< a path, or the camera itself as an object
};

struct SceneKey {
  std::string_view section;  ///< of the file; "surface" are those of the first object that is a surface
  std::string_view key;
  std::string_view option;  ///< "--select"; "FILE", "-o"
  SceneValue value;
  bool shows = false;           ///< a picture or an export without it would show something else
  std::string_view usual = {};  ///< of a text: the value that is the same as nothing
};

/// In the order in which scenes are written. Not in them: where and how much is computed, what is told of it, and what
/// is written beside it.
std::span<const SceneKey> scene_keys();

}  // namespace meniscus
