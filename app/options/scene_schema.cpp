// SPDX-License-Identifier: BSD-3-Clause
// Describes the keys of scene files, for people and as a JSON schema, by the table of properties.
#include "app/options/scene_schema.h"



#include "core/properties/properties.h"
#include "core/scene/scene_json.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

Json type_of(SceneForm value) {
  const Json text{{"type", {"string", "number"}}};
  const Json path{{"type", "string"}, {"minLength", 1}};
  const auto one_or_more = [](const Json& one) { return Json{{"anyOf", {one, {{"type", "array"}, {"items", one}}}}}; };
  switch (value) {
    case SceneForm::flag:
    case SceneForm::negated:
      return {{"type", "boolean"}};
    case SceneForm::list:
      return one_or_more(text);
    case SceneForm::path:
      return path;
    case SceneForm::paths:
      return one_or_more(path);
    case SceneForm::text_or_flag:
      return {{"type", {"string", "number", "boolean"}}};
    case SceneForm::camera:
      return {{"anyOf", {path, {{"type", "object"}}}}};
    case SceneForm::text:
      break;
  }
  return text;
}

Json described(const Property& property) {
  Json type = type_of(scene_form(property));
  if (property.type == ValueType::word) type = {{"enum", words_of(property)}};
  if (property.has_range() && scene_form(property) == SceneForm::text) {
    type["minimum"] = property.lowest;
    type["maximum"] = property.highest;
  }
  type["description"] = help_of(property);
  return type;
}

/// Returns the keys of scene files in one section, or in all but one.
template <typename Chosen>
std::vector<const Property*> scene_properties(const Chosen& is_chosen) {
  std::vector<const Property*> chosen;
  for (const Property* property : properties())
    if (property->has(in_scene) && is_chosen(property->section())) chosen.push_back(property);
  return chosen;
}

bool is_surface(std::string_view section) { return section == "surface"; }
bool is_other(std::string_view section) { return section != "surface"; }

Json strict(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

}  // namespace

std::string scene_help() {
  std::string page = R"(Examples:
  meniscus render 1tii.pdb --color chain --sticks ligand -o fig.png --save-scene fig.json
  meniscus render --scene fig.json                     the same picture
  meniscus fig.json                                    the same picture
  meniscus render --scene fig.json --size 3840x2160    options override the scene
  meniscus render --scene fig.png                      the scene in a picture (.png), next to its molecule
  meniscus export povray --scene fig.json -o fig       the same figure for POV-Ray, or a message

A scene is a JSON file: {"meniscus_scene": 1, SECTION: {KEY: VALUE, ...}, ..., "objects": [...]}. Paths are relative
to its folder. Options on the command line override the scene; repeatable options are added to it. The keys, with the
options whose values they take:

)";
  std::string_view section;
  for (const Property* property : scene_properties(is_other)) {
    if (property->section() != section) page += fmt::format("{}\n", section = property->section());
    page += fmt::format("  {:<26}{}\n", property->name(), property->long_option());
  }
  page += R"(
"objects" is a list. Each object has a "representation" (surface, sticks, balls, spheres, tube, bases, glycans, hydrogen_bonds, distance) and a "selection".
The first surface is that of the molecule. Its keys:

)";
  for (const Property* property : scene_properties(is_surface))
    page += fmt::format("  {:<26}{}\n", property->name(), property->long_option());
  page += R"(
All others consist of their own atoms alone, which may lie outside molecule.select. Their keys, as for --object:

)";
  for (const ObjectKey& key : object_keys())
    page += fmt::format("  {:<26}{}{}\n", key.name, key.property->long_option(),
                        !key.of_shapes     ? "; of surfaces"
                        : !key.of_surfaces ? " or --tube-radius; of sticks, tubes and dashes"
                                           : "");
  return page;
}

std::string scene_schema() {
  Json sections;
  sections["meniscus_scene"] = {{"const", 1}};
  Json own, surface;
  for (const Property* property : scene_properties(is_surface))
    surface[std::string(property->name())] = described(*property);
  for (const Property* property : scene_properties(is_other))
    own[std::string(property->section())][std::string(property->name())] = described(*property);
  for (const auto& [section, keys] : own.items()) sections[section] = strict(keys);
  Json object = surface;
  for (const ObjectKey& key : object_keys())
    if (const std::string name(key.name); !object.contains(name)) object[name] = described(*key.property);
  object["selection"] = {{"type", "string"}, {"description", "The atoms of the object"}};
  Json representations = Json::array({"surface"});
  for (const char* const word : kShapeWords) representations.push_back(word);
  object["representation"] = {{"enum", representations}};
  sections["superposed"] = {{"type", "array"},
                            {"description", "Files that were superposed, with atoms and RMSD; ignored"}};
  sections["objects"] = {{"type", "array"}, {"items", strict(object)}};
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Meniscus scene"}};
  const Json body = strict(sections);
  for (const auto& [key, value] : body.items()) schema[key] = value;
  schema["required"] = {"meniscus_scene"};
  return schema.dump(2) + "\n";
}

}  // namespace meniscus
