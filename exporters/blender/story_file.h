// SPDX-License-Identifier: BSD-3-Clause
// A storyboard beside its .mns files: when each scene is shown, by which camera, before which background.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "exporters/blender/mns_file.h"

namespace meniscus::blender {

struct StoryScene {
  std::string name, title;            ///< of its file, without ending; what was written into its pictures
  std::string file;                   ///< with its surface, in the same folder
  std::uint64_t first = 0, last = 0;  ///< frames that show it, from 1; between two scenes one goes over into the next
  Shot shot;
  std::optional<glm::vec3> background;  ///< sRGB; nothing: transparent
};

struct Story {
  std::vector<StoryScene> scenes;
  bool is_smooth = true;   ///< transitions start and end slowly
  glm::dvec3 origin{0.0};  ///< Å, the middle of all that is shown
  double scale = 0.1;      ///< Blender units per Å
  double fps = 25.0;
};

/// "scene_2.mns", of a place from 0
std::string scene_file(std::size_t place);

/// story.json as FORMAT.md describes it.
std::string story_json(const Story& story);

}  // namespace meniscus::blender
