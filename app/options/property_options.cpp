// SPDX-License-Identifier: BSD-3-Clause
// Declares the sets of properties that commands share, adds options to CLI11, and writes scenes as options and their
// keys as text and as a schema.
#include "app/options/property_options.h"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "app/film/film.h"
#include "app/process/program_main.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_value.h"

namespace meniscus {
namespace {

/// Accepts numbers within the range of a property.
CLI::Validator within(const Property& property) {
  return CLI::Validator(
      [&property](std::string& text) -> std::string {
        try {
          scene_values::number_in_range(property, text);
          return {};
        } catch (const RequestError& error) {
          return error.what();
        }
      },
      "");
}

bool is_film(const GivenScene& given) { return is_film_path(given.scene.output); }

/// Returns the properties of figures, as pictures or for other programs.
TakenProperties shown_properties() {
  return run_properties().with({"Surface", "-surface.patches", "-surface.min_patch", "Colour", "Figure",
                                "-surface.clip_all", "Shapes", "Camera", "image.size", "image.width", "image.height",
                                "image.dpi", "output.file", "scene.save"});
}

}  // namespace

void TakenProperties::add(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs) {
  needs_.insert(needs_.end(), needs);
  for (std::string_view name : names) {
    const bool is_left_out = name.starts_with('-');
    name.remove_prefix(is_left_out ? 1 : 0);
    bool is_known = false;
    for (const Property* property : properties()) {
      if (property->heading != name && property->key != name) continue;
      is_known = true;
      if (is_left_out)
        taken_.erase(property);
      else
        taken_.insert(property);
    }
    if (!is_known) throw std::logic_error(fmt::format("{} is neither a heading nor a key of properties", name));
  }
}

TakenProperties TakenProperties::with(std::initializer_list<std::string_view> names,
                                      std::initializer_list<Need> needs) const {
  TakenProperties more = *this;
  more.add(names, needs);
  return more;
}

const TakenProperties& run_properties() {
  static const TakenProperties taken(
      {"Input", "Radii", "Assembly", "Frames", "Alignment of frames", "surface.kind", "surface.probe", "Computing",
       "output.force", "scene.read", "scene.trust", "scene.set"},
      {{{"frames.jobs", "frames.progress"},
        [](const GivenScene& given) { return given.scene.frames.is_requested(); },
        "there is no run of frames"}});
  return taken;
}

const TakenProperties& figure_properties() {
  static const TakenProperties taken =
      shown_properties().with({}, {{{"image.dpi"},
                                    {"image.width", "image.height"},
                                    "the size is in pixels; add --width or --height with a length, such as 85mm"},
                                   fixed_size_need()});
  return taken;
}

const TakenProperties& render_properties() {
  static const TakenProperties taken = shown_properties().with(
      {"Surface", "Figure", "Film", "Light", "Lines", "-look.material", "Picture", "Legend", "Labels"},
      {film_need(), {{"frames.fps"}, is_film, "the output is not a film"}});
  return taken;
}

Need fixed_size_need() {
  return {{"image.size", "image.height"},
          [](const GivenScene& given) { return !given.scene.picture.fits; },
          "auto is for `meniscus render`; give a size",
          true};
}

Need film_need() {
  return {{"frames.codec", "frames.crf", "frames.bits", "frames.chroma"},
          is_film,
          "the output is not a film; name one, such as -o a.mp4",
          true};
}

Need superposition_need(Condition condition) {
  return {
      {"frames.superpose", "frames.center", "frames.reference"},
      std::move(condition),
      "areas and volumes stay the same however a frame is turned and moved; places and gradients, which are written "
      "to files, do not"};
}

CLI::Validator proposes(const std::vector<std::string>& words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", CLI::detail::join(words, "|"));
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return {};
    return fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", "));
  };
  return CLI::Validator(check, "", CLI::detail::join(words, "|"));
}

std::string group_of(const Property& property) { return std::string(property.has(rare) ? "" : property.heading); }

template <typename Target>
CLI::Option* PropertyOptions::add(std::string_view key, Target& target) {
  const Property& property = property_of(key);
  if constexpr (std::same_as<Target, bool>)
    return finish(property, command_.add_flag(std::string(property.option), target));
  else
    return finish(property, command_.add_option(std::string(property.option), target));
}
template CLI::Option* PropertyOptions::add(std::string_view key, bool& target);
template CLI::Option* PropertyOptions::add(std::string_view key, int& target);
template CLI::Option* PropertyOptions::add(std::string_view key, double& target);
template CLI::Option* PropertyOptions::add(std::string_view key, unsigned& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::uint64_t& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::optional<int>& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::optional<std::uint64_t>& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::string& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::filesystem::path& target);
template CLI::Option* PropertyOptions::add(std::string_view key, std::vector<std::string>& target);

CLI::Option* PropertyOptions::add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse) {
  const Property& property = property_of(key);
  return finish(property, command_.add_option_function<std::string>(std::string(property.option), parse));
}

CLI::Option* PropertyOptions::add_selection(std::string_view key, std::optional<Selection>& selection) {
  const std::string name(property_of(key).long_option());
  return add_parsed(key,
                    [name, &selection](const std::string& text) { selection = parse_selection_option(name, text); });
}

CLI::Option* PropertyOptions::add_switch(std::string_view key, const std::function<void()>& turn_on) {
  const Property& property = property_of(key);
  return finish(property, command_.add_flag_callback(std::string(property.option), turn_on));
}

std::size_t PropertyOptions::place_of_word(const Property& property, const std::string& text) {
  try {
    return scene_values::place_of_word(words_of(property), text);
  } catch (const RequestError& error) {
    throw CLI::ValidationError(std::string(property.long_option()), error.what());
  }
}

CLI::Option* PropertyOptions::finish(const Property& property, CLI::Option* option) const {
  option->description(help_of(property))->group(group_of(property));
  if (property.type == ValueType::flag) return option;
  option->type_name(std::string(property.value));
  if (property.has(repeatable)) option->allow_extra_args(false);
  if (property.has(value_optional)) option->expected(0, 1);
  // The range of a text is a length in pixels, which its own parser checks.
  if (property.has_range() && (property.type == ValueType::number || property.type == ValueType::count))
    option->check(within(property));
  if (!property.words.empty()) option->check(proposes(words_of(property)));
  return option;
}

std::size_t place_of(const std::string& text, const Property& property) {
  try {
    return scene_values::place_of_word(words_of(property), text);
  } catch (const RequestError& error) {
    throw UsageError("{}: {}", property.long_option(), error.what());
  }
}

Selection parse_selection_option(const std::string& option, const std::string& text) {
  try {
    return parse_selection(text);
  } catch (const SelectionError& error) {
    throw SelectionError(option + ": " + error.sentence(), error.picture());
  }
}

std::vector<std::string> scene_words(const Scene& scene,
                                     const std::function<std::string(const std::string& path)>& path) {
  const auto named = [&](const Property& property, const std::string& text) {
    const bool is_file =
        property.type == ValueType::file || (property.type == ValueType::camera && !text.starts_with('{'));
    return is_file && path ? path(text) : text;
  };
  std::vector<std::string> words{named(property_of("molecule.file"), scene.molecule.file)};
  for (const Property* property : properties()) {
    if (!is_scene_value(*property)) continue;
    if (property->key == "molecule.file" || property->key == "output.file") continue;
    const std::string option(property->long_option());
    for (const std::string& given : value_texts(scene, *property)) {
      const std::string text = named(*property, given);
      if (property->type == ValueType::flag) {
        words.push_back(option);
      } else if (text.starts_with('-') || text.empty()) {  // such a text would be read as an option, or be lost
        words.push_back(fmt::format("{}={}", option, text));
      } else {
        words.push_back(option);
        words.push_back(text);
      }
    }
  }
  return words;
}

std::vector<std::string> render_words(const Scene& scene) {
  std::vector<std::string> words{"meniscus", "render"};
  const std::vector<std::string> values = scene_words(scene);
  words.insert(words.end(), values.begin(), values.end());
  if (!scene.output.empty()) words.insert(words.end(), {"-o", scene.output});
  return words;
}

std::string shell_line(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain =
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,+=") ==
            std::string::npos &&
        !word.empty();
    line += (line.empty() ? "" : " ") + (plain ? word : escaped(shell_word(word)));
  }
  return line;
}

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
