// SPDX-License-Identifier: BSD-3-Clause
// A film of the pictures of a scene: the pictures it shows in order, with the pairs that it blends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exporters/povray/povray_options.h"

namespace meniscus::povray {

/// A picture of the film: a frame of the scene, or two of them blended in linear light.
struct StoryPicture {
  std::uint64_t first = 0;   ///< number of the first frame
  std::uint64_t second = 0;  ///< number of the second frame; 0 if there is none
  double share = 0.0;        ///< weight of the second frame, in [0, 1]
};

/// The pictures of a film in order.
struct Story {
  std::vector<StoryPicture> pictures;
  double rate = 25.0;  ///< pictures per second
};

/// Returns the text of <name>_story.pov, which shows the pictures that <name>.ini rendered.
std::string story_text(const SceneOptions& options, const Story& film);
/// Returns the text of <name>_story.ini.
std::string story_ini_text(const SceneOptions& options, const Story& film);

}  // namespace meniscus::povray
