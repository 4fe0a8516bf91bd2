// SPDX-License-Identifier: BSD-3-Clause
// Storyboard files: the scenes of a film in one JSON file, with the times of the film.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The content of a storyboard file.
struct StoryboardFile {
  std::vector<std::string> scenes;       ///< the JSON of each scene, as scene_text() returns it
  std::vector<double> hold, transition;  ///< seconds of each, or one number for all; empty: the defaults of the film
};

/// Returns the text of a storyboard file, ending with a newline.
std::string storyboard_text(const StoryboardFile& story);

/// Reads a storyboard file. Returns nothing for a file that is something else. Throws InputError if a storyboard is
/// damaged, and the errors of read_text_file().
std::optional<StoryboardFile> read_storyboard(const std::string& file);

/// Returns the JSON of a scene by a name such as "story.json#2", which is the second scene of the storyboard
/// story.json. Returns nothing for other names. Throws InputError if the storyboard has no such scene.
std::optional<std::string> scene_of_storyboard(const std::string& name);

}  // namespace meniscus
