// SPDX-License-Identifier: BSD-3-Clause
// The storyboard of a film, in addition to its .mns files: the frames, the camera and the background of each scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "exporters/blender/mns_file.h"

namespace meniscus::blender {

/// A scene of a film.
struct StoryScene {
  std::string name, title;  ///< name of its scene file without ending; title that was written into its pictures
  std::string file;         ///< file with its surface, in the same folder
  std::uint64_t first = 0, last = 0;  ///< frames that show it, from 1; frames between two scenes are a transition
  Shot shot;
  std::optional<glm::vec3> background;  ///< sRGB; empty if transparent
};

/// The scenes of a film in order.
struct Story {
  std::vector<StoryScene> scenes;
  bool is_smooth = true;   ///< true if transitions start and end slowly
  glm::dvec3 origin{0.0};  ///< middle of everything that is shown, Å
  double scale = 0.1;      ///< Blender units per Å
  double fps = 25.0;       ///< frames per second
};

/// Returns the file name of the scene at a place from 0, such as "scene_2.mns" for place 1.
std::string scene_file(std::size_t place);

/// Returns the text of story.json as FORMAT.md describes it.
std::string story_json(const Story& story);

}  // namespace meniscus::blender
