// SPDX-License-Identifier: BSD-3-Clause
// Writes a storyboard for Blender as JSON.
#include "exporters/blender/story_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"

namespace meniscus::blender {

std::string scene_file(std::size_t place) { return fmt::format("scene_{}.mns", place + 1); }

std::string story_json(const Story& story) {
  using nlohmann::ordered_json;
  ordered_json content{{"format", "meniscus storyboard"},
                       {"version", 1},
                       {"generator", "meniscus " MENISCUS_VERSION},
                       {"unit", "angstrom"},
                       {"origin", {story.origin.x, story.origin.y, story.origin.z}},
                       {"scale", story.scale},
                       {"fps", story.fps},
                       {"ease", story.is_smooth ? "smooth" : "even"},
                       {"scenes", ordered_json::array()}};
  for (const StoryScene& scene : story.scenes) {
    ordered_json entry{{"name", scene.name},
                       {"file", scene.file},
                       {"first", scene.first},
                       {"last", scene.last},
                       {"camera", shot_object(scene.shot)}};
    if (!scene.title.empty()) entry["title"] = scene.title;
    if (const auto& color = scene.background) entry["background"] = {color->x, color->y, color->z};
    content["scenes"].push_back(std::move(entry));
  }
  return content.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace meniscus::blender
