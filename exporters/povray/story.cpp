// SPDX-License-Identifier: BSD-3-Clause
// Writes the scene that makes a film of rendered pictures.
#include "exporters/povray/story.h"

#include <string_view>

#include <fmt/format.h>

#include "core/base/text.h"
#include "exporters/povray/scene_templates.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

std::string story_text(const SceneOptions& options, const Story& story) {
  const std::vector<StoryPicture>& film = story.pictures;
  SceneText out;
  out.literal("// The film: each of its pictures is one of those that ").literal(options.name);
  out.literal(".ini renders, or two of them blended in linear light.\n#version 3.7;\n");
  const auto list = [&](std::string_view name, const auto& append) {
    out.literal("#declare ").literal(name).literal(" = array[").count(film.size()).literal("] {");
    for (std::size_t n = 0; n < film.size(); ++n) append(out.literal(n == 0 ? "" : n % 16 == 0 ? ",\n" : ","), film[n]);
    out.literal("};\n");
  };
  out.literal("// Numbers of pictures, 0 where there is none; and the share of the second.\n");
  list("Meniscus_First", [](SceneText& text, const StoryPicture& picture) { text.count(picture.first); });
  list("Meniscus_Second", [](SceneText& text, const StoryPicture& picture) { text.count(picture.second); });
  list("Meniscus_Share", [](SceneText& text, const StoryPicture& picture) { text.ratio(picture.share); });
  out.literal(filled(template_text(povray_templates(), "story.pov"), {{"NAME", options.name}}));
  return out.text();
}

std::string story_ini_text(const SceneOptions& options, const Story& film) {
  return filled(template_text(povray_templates(), "story.ini"), {{"NAME", options.name},
                                                                 {"WIDTH", std::to_string(options.width)},
                                                                 {"HEIGHT", std::to_string(options.height)},
                                                                 {"COUNT", std::to_string(film.pictures.size())},
                                                                 {"RATE", fmt::format("{:g}", film.rate)}});
}

}  // namespace meniscus::povray
