// SPDX-License-Identifier: BSD-3-Clause
// Finds the names that a scene declares, and writes the include that undefines them.
#include "exporters/povray/own_scene.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/base/text.h"
#include "exporters/povray/povray_files.h"
#include "exporters/povray/scene_templates.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {
namespace {

using Names = std::set<std::string_view>;

/// True for the names that the include is meant to declare, and for the one that marks a scene of the user's own.
bool is_kept(std::string_view name) {
  return name == "Meniscus_Own_Scene" || name == "Meniscus_Surface" || name == "Meniscus_Shapes" ||
         name.starts_with("Meniscus_Object_");
}

/// Adds the identifiers that follow each occurrence of `word` in `text`.
void add_names(std::string_view text, std::string_view word, Names& names) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at)) {
    at += word.size();
    const std::string_view name = text.substr(at, text.find_first_not_of(kLetters, at) - at);
    if (!is_kept(name)) names.insert(name);
  }
}

}  // namespace

std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps) {
  const std::string colors = colors_text({}, {});  // each frame of a run may have its own list of colours
  std::vector<std::string_view> all(texts.begin(), texts.end());
  all.insert(all.end(),
             {colors, template_text(povray_templates(), "caps.inc"), template_text(povray_templates(), "shapes.inc")});
  if (maps) all.push_back(template_text(povray_templates(), "map.inc"));
  Names declared, settings;
  for (const std::string_view text : all) {
    add_names(text, "#declare ", declared);
    add_names(text, "#macro ", declared);
    add_names(text, "#ifndef (", settings);
  }
  SceneText out;
  out.literal("// For a scene of your own: declares Meniscus_Surface, and places nothing.\n");
  out.literal("//   #version 3.7;\n//   global_settings { assumed_gamma 1 }\n//   #include \"").literal(name);
  out.literal(".inc\"\n//   object { Meniscus_Surface rotate 30*y }\n");
  out.literal(
      "// What is beside the surface is Meniscus_Shapes, and further objects are Meniscus_Object_1 and so on.\n");
  out.literal(
      "// Each name of the list below may be declared before, and stays as you declared it. All other names are\n");
  out.literal("// taken back at the end: include the file again with other settings, or another surface.\n");
  const auto line = [&](std::string_view test, std::string_view prefix, std::string_view directive,
                        std::string_view symbol) {
    out.literal(test).literal(prefix).literal(symbol).literal(")").literal(directive).literal(symbol);
  };
  for (const std::string_view setting : settings) {
    line("#ifdef (", "", " #local Keeps_", setting);
    out.literal(" = 1; #end\n");
  }
  out.literal("#declare Meniscus_Own_Scene = 1;\n#include \"")
      .literal(name)
      .literal(".pov\"\n#undef Meniscus_Own_Scene\n");
  for (const std::string_view setting : settings) {
    line("#ifndef (", "Keeps_", " #ifdef (", setting);
    out.literal(") #undef ").literal(setting).literal(" #end #end\n");
  }
  for (const std::string_view internal : declared) {
    if (settings.contains(internal)) continue;
    line("#ifdef (", "", " #undef ", internal);
    out.literal(" #end\n");
  }
  return out.text();
}

}  // namespace meniscus::povray
