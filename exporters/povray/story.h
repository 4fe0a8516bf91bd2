// SPDX-License-Identifier: BSD-3-Clause
// A film of the pictures of a scene: which it shows, how often, and which it blends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// A picture of the film: a frame of the scene, or two of them blended in linear light.
struct StoryPicture {
  std::uint64_t first = 0;   ///< number of the frame
  std::uint64_t second = 0;  ///< 0: none
  double share = 0.0;        ///< of the second
};

struct Story {
  std::vector<StoryPicture> pictures;
  double rate = 25.0;  ///< pictures a second
};

/// <name>_story.pov: shows the pictures that <name>.ini rendered.
std::string story_text(const SceneOptions& options, const Story& film);
/// <name>_story.ini.
std::string story_ini_text(const SceneOptions& options, const Story& film);

}  // namespace meniscus::povray
