// SPDX-License-Identifier: BSD-3-Clause
// Declares options by the table of properties, and sets a scene by a scene file and the command line.
#include "app/options/scene_options.h"

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "app/film/film.h"
#include "app/options/command_tree.h"
#include "app/options/named_files.h"
#include "app/process/program_main.h"
#include "core/base/binary_file.h"
#include "core/base/system_file.h"
#include "core/image/png_file.h"
#include "core/mesh/tessellate.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

/// Reads from the environment which GPUs this process may see and take, and where it keeps their kernels.
void read_environment(DeviceChoice& choice) {
  const char* const kept = std::getenv(kKernelVariable);
  if (const std::string cache = cache_folder(); !cache.empty() && !(kept && std::string_view(kept) == "off"))
    choice.kernel_folder = cache + "/kernels";
  if (const char* const visible = std::getenv("CUDA_VISIBLE_DEVICES")) choice.cuda_visible = visible;
  for (const char* const variable : {"SLURM_LOCALID", kWorkerVariable}) {
    const char* const text = std::getenv(variable);
    int number = -1;
    if (text && std::from_chars(text, text + std::strlen(text), number).ec == std::errc() && number >= 0)
      choice.worker = number;
  }
}

/// Returns proposed words that other tables define.
std::vector<std::string> proposed_words(std::string_view key) {
  std::vector<std::string> words;
  const auto add = [&](const auto& table, auto name) {
    for (const auto& row : table) words.emplace_back(name(row));
  };
  if (key == "surface.color") add(color_schemes(), [](const auto& row) { return row.word; });
  if (key == "surface.map") add(color_maps(), [](const auto& row) { return row.name; });
  if (key == "camera.view") words = view_direction_words();
  if (key == "mesh.format") add(mesh_formats(), [](const auto& row) { return row.word; });
  if (key == "mesh.attributes") {
    words = {"usual", "all", "none"};
    add(vertex_number_kinds(), [](const auto& row) { return row.name; });
  }
  if (key == "molecule.radii") {
    words = {"file"};
    add(radii_sets(), [](const auto* row) { return row->name; });
  }
  return words;
}

void add_option(CLI::App& command, const Property& property) {
  const std::string name(property.option);
  if (property.type == ValueType::flag) {
    command.add_flag(name)->description(help_of(property))->group(group_of(property));
    return;
  }
  // Values are parsed when all of them are known.
  CLI::Option* const option = command.add_option(name)->description(help_of(property))->group(group_of(property));
  option->type_name(std::string(property.value));
  if (property.has(repeatable)) option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->expected(1);
  if (property.has(value_optional)) option->expected(0, 1);
  if (property.key == "look.light") option->delimiter(',')->expected(3);
  std::vector<std::string> words = proposed_words(property.key);
  if (words.empty()) words = words_of(property);
  if (!words.empty()) option->check(proposes(words));
}

/// Gives a film the size of a screen, or a GIF half of it.
void size_film(Scene& scene) {
  if (!is_film_path(scene.output)) return;
  const bool is_gif = scene.film.codec == "gif" || std::filesystem::path(scene.output).extension() == ".gif";
  scene.picture.width = is_gif ? 960 : 1920;
  scene.picture.height = is_gif ? 540 : 1080;
}

bool is_path(const Property& property) {
  return property.type == ValueType::file || property.type == ValueType::new_file || property.type == ValueType::camera;
}

}  // namespace

SceneOptions::SceneOptions(CLI::App& command, TakenProperties taken, SceneCommand& into)
    : command_(command), taken_(std::move(taken)), into_(into) {
  for (const Property* property : properties()) {
    if (!taken_.has(*property)) continue;
    if (is_scene_value(*property))
      add_option(command, *property);
    else
      add_own_option(*property);
  }
  if (command.get_option_no_throw("--device")) read_environment(into.scene.molecule.surface.gl);
  if (command.get_option_no_throw("FILE"))
    option("molecule.file")->description("Molecule: " + format_names() + "; .gz too; - is standard input")->required();
  if (taken_.has("frames.frames")) into.scene.frames.index_folder = cache_folder();
}

/// Adds an option that sets how the work is done, or the trajectories after FILE.
void SceneOptions::add_own_option(const Property& property) {
  PropertyOptions options(command_);
  const std::string_view key = property.key;
  if (key == "molecule.warnings")
    options.add_word(key, into_.reporting.warnings, {WarningDetail::full, WarningDetail::summary, WarningDetail::none});
  if (key == "molecule.quiet") options.add(key, into_.reporting.quiet);
  if (key == "molecule.verbose") options.add(key, into_.reporting.verbose);
  if (key == "frames.jobs") options.add(key, into_.jobs);
  if (key == "frames.progress") {
    using enum ProgressStyle;
    options.add_word(key, into_.reporting.progress, {automatic, bar, plain, json, openjd, none});
  }
  if (key == "frames.trajectories")
    command_.add_option_function<std::vector<std::string>>("TRAJECTORY", [](const std::vector<std::string>&) {})
        ->description(help_of(property))
        ->group(std::string(property.heading))
        ->allow_extra_args()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (key == "camera.save") options.add(key, into_.save_camera);
  if (key == "output.force") options.add(key, into_.force);
  if (key == "picture.any_cost") options.add(key, into_.any_cost);
  if (key == "scene.save") options.add(key, into_.save_scene);
  if (key == "scene.set")
    command_.add_option(std::string(property.option))
        ->description(help_of(property))
        ->type_name(std::string(property.value))
        ->group(std::string(property.heading))
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1);
  if (key == "scene.trust") options.add_switch(key, [] {});
  if (key == "scene.read")
    options.add_parsed(key, [this](const std::string& path) {
      if (path.empty()) throw UsageError("--scene needs a FILE");
      file_ = path;
      option("molecule.file")->required(false);
    });
}

CLI::Option* SceneOptions::option(std::string_view key) const {
  return command_.get_option(std::string(property_of(key).long_option()));
}

bool SceneOptions::has_option(const Property& property) const {
  return taken_.has(property) && is_scene_value(property);
}

void SceneOptions::describe_output(const std::string& what, OutputName name) {
  takes_output_of_scene_ = name == OutputName::optional;
  option("output.file")->description(what)->required(name == OutputName::required);
}

bool SceneOptions::typed(std::string_view key) const {
  const CLI::Option* const option = command_.get_option_no_throw(std::string(property_of(key).long_option()));
  if (key == "frames.trajectory" && command_.get_option_no_throw("TRAJECTORY") && command_.count("TRAJECTORY") > 0)
    return true;
  return option && option->count() > 0;
}

std::vector<std::string> SceneOptions::typed_texts(const Property& property) const {
  std::vector<std::string> texts;
  if (property.key == "frames.trajectory" && command_.get_option_no_throw("TRAJECTORY"))
    texts = command_.get_option("TRAJECTORY")->results();
  const CLI::Option* const given = option(property.key);
  if (given->count() == 0) return texts;
  const std::vector<std::string>& all = given->results();
  if (property.has(repeatable)) {
    texts.insert(texts.end(), all.begin(), all.end());
  } else if (property.key == "look.light") {
    const std::size_t first = all.size() > 3 ? all.size() - 3 : 0;
    texts = {fmt::format("{}", fmt::join(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(), ","))};
  } else {
    texts = {all.empty() ? std::string() : all.back()};
  }
  return texts;
}

void SceneOptions::refuse(std::string_view key, const std::string& what) const {
  const auto place = places_.find(std::string(key));
  if (place != places_.end() && !typed(key))
    throw UsageError(place->second.starts_with("--") ? fmt::format("{}: {}", place->second, what)
                                                     : fmt::format("{}: {}: {}", escaped(file_), place->second, what));
  throw CLI::ValidationError(std::string(property_of(key).long_option()), what);
}

void SceneOptions::set(const Property& property, const std::vector<std::string>& texts) {
  try {
    set_value(into_.scene, property, texts);
  } catch (const SelectionError& error) {
    const auto place = places_.find(std::string(property.key));
    const std::string where = place == places_.end() || typed(property.key) ? std::string(property.long_option())
                              : place->second.starts_with("--")             ? place->second
                                                                : fmt::format("{}: {}", escaped(file_), place->second);
    throw SelectionError(fmt::format("{}: {}", where, error.sentence()), error.picture());
  } catch (const ValueError& error) {
    refuse(property.key, error.what());
  }
}

std::vector<SceneSetting> SceneOptions::read_scene_file(const std::vector<std::string>& named) {
  if (file_.empty()) return {};
  std::vector<std::string> words;
  for (const CLI::Option* option : command_.get_options())
    words.insert(words.end(), option->results().begin(), option->results().end());
  const SceneTrust trust{
      file_,
      std::move(words),
      named,
      command_.count("--trust-scene") > 0 || std::ranges::find(named, "--trust-scene") != named.end(),
      command_.get_option_no_throw("--force") && command_.count("--force") > 0,
      "name that file on the command line, or add --trust-scene if the scene is yours"};
  std::vector<SceneSetting> settings = parse_scene(read_scene_text(file_), file_);
  std::erase_if(settings, [&](const SceneSetting& setting) {
    const Property& property = *setting.property;
    // The name of a picture is not suitable for the folder of an export.
    if (property.key == "output.file" && !takes_output_of_scene_) return true;
    return is_path(property) && !property.has(repeatable) && typed(property.key);
  });
  for (SceneSetting& setting : settings)
    for (std::string& text : setting.texts)
      if (is_path(*setting.property) && !(setting.property->type == ValueType::camera && text.starts_with('{')))
        text = trust.path(*setting.property, text, setting.place);
  if (!typed("molecule.file") &&
      std::ranges::none_of(settings, [](const auto& setting) { return setting.property->key == "molecule.file"; }))
    throw InputError(file_, 0, "scene: molecule.file is missing; name it there, or on the command line");
  return settings;
}

/// Throws, before outputs are checked, for a file that does not exist: the error of reading it, or an error that names
/// the scene and the key that refer to it.
void SceneOptions::check_inputs() const {
  if (typed("report.csv_summary")) return;  // because a table of many files has a row for each missing one
  for (const Property* property : properties()) {
    if (property->type != ValueType::file || !has_option(*property) || !is_given(property->key)) continue;
    for (const std::string& path : value_texts(into_.scene, *property)) {
      std::error_code ignored;
      if (path == "-" || std::filesystem::exists(path_of_text(path), ignored)) continue;
      if (typed(property->key) || file_.empty()) BinaryFile(path, Contents::atoms);
      throw InputError(file_, 0,
                       "scene: {} is {}, but there is no such file, nor one of this name in the working folder",
                       property->key, in_quotes(path));
    }
  }
}

/// Throws if an output, of an option or of a setting, would replace an input of the command or another output.
void SceneOptions::guard_files(std::span<const SceneSetting> settings) const {
  NamedFiles files(command_);
  if (!file_.empty()) files.read(file_);
  for (const SceneSetting& setting : settings)
    for (const std::string& text : setting.texts) {
      if (setting.property->type == ValueType::new_file)
        files.write(std::string(setting.property->long_option()), text);
      else if (setting.property->type == ValueType::file || setting.property->type == ValueType::camera)
        files.read(text);
    }
  files.check();
}

/// Returns the values of --set in the form of a scene file's settings.
std::vector<SceneSetting> SceneOptions::typed_settings() const {
  std::vector<SceneSetting> settings;
  const CLI::Option* const option = command_.get_option_no_throw("--set");
  if (!option) return settings;
  for (const std::string& text : option->results()) {
    const std::size_t sign = std::min(text.find('='), text.size());
    const std::string key = text.substr(0, sign);
    std::vector<std::string_view> keys;
    const Property* named = nullptr;
    for (const Property* property : properties()) {
      if (!has_option(*property)) continue;
      keys.push_back(property->key);
      if (property->key == key) named = property;
    }
    if (!named || sign == text.size()) {
      const std::string_view nearest = nearest_word(key, keys);
      throw CLI::ValidationError(
          "--set", named ? fmt::format("{} has no value; write KEY=VALUE", in_quotes(text))
                         : fmt::format("{} is not a key that {} has{}; meniscus help scenes lists them", in_quotes(key),
                                       command_path(command_),
                                       nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
    }
    settings.push_back({named, {text.substr(sign + 1)}, "--set " + key});
  }
  return settings;
}

void SceneOptions::take_setting(const SceneSetting& setting) {
  const Property& property = *setting.property;
  if (taken_.has(property)) {
    places_[std::string(property.key)] = setting.place;
    return set(property, setting.texts);
  }
  left_out_.emplace_back(property.key);
  const bool shows = has_option(property_of("surface.color"));
  if (!shows || !property.has(needs_support)) return;
  Scene alone;
  set_value(alone, property, setting.texts);
  if (!value_texts(alone, property).empty())
    throw UsageError("{}: {}: {} cannot show that ({}); leave it out of the scene, or choose render", escaped(file_),
                     setting.place, command_path(command_), property.long_option());
}

void SceneOptions::take(const std::vector<std::string>& named) {
  std::vector<SceneSetting> settings = read_scene_file(named);
  const std::vector<SceneSetting> typed_by_key = typed_settings();
  const auto take_values = [&](const Property* property) {
    const bool is_overruled = !typed(property->key) && std::ranges::any_of(properties(), [&](const Property* other) {
      if (other->excluded.empty() || !has_option(*other)) return false;
      const std::vector<std::string> keys = parted(other->excluded);
      return std::ranges::find(keys, property->key) != keys.end() && typed(other->key);
    });
    for (const SceneSetting& setting : settings)
      if (setting.property == property && !is_overruled) take_setting(setting);
    for (const SceneSetting& setting : typed_by_key)
      if (setting.property == property) take_setting(setting);
    if (!has_option(*property)) return;
    if (const std::vector<std::string> texts = typed_texts(*property); !texts.empty() || typed(property->key))
      set(*property, texts);
  };
  for (const Property* property : properties())
    if (is_scene_value(*property)) take_values(property);
  check_table();
  check_inputs();
  turn_one_molecule();
  if (taken_.has("frames.codec") && file_.empty() && !is_given("image.size") && !is_given("image.width") &&
      !is_given("image.height"))
    size_film(into_.scene);
  into_.scene.molecule.surface.check = check_by_mesh;
  const Preset& preset = preset_of(into_.scene.look.preset);
  try {
    complete(into_.scene);
  } catch (const ValueError& error) {
    refuse(error.key(), error.what());
  }
  for (const PresetSetting& setting : preset.settings)  // a default that is given counts, too
    if (const Property& property = property_of(setting.key); !property.has(repeatable) && is_given(setting.key))
      take_values(&property);
  settings.insert(settings.end(), typed_by_key.begin(), typed_by_key.end());
  guard_files(settings);
  const auto has_value = [&](std::string_view key) { return is_given(key) || preset.sets(key); };
  const GivenScene given{into_.scene, has_value, is_live_};
  std::vector<std::string> sentences;
  if (preset.sets("camera.zoom_to") && !is_given("camera.zoom_to") && !is_given("camera.look_into"))
    sentences.push_back(fmt::format("note: --preset {} looks at the first of {}; --zoom-to EXPR names other atoms",
                                    preset.word, in_quotes(preset.needs)));
  for (SceneNote& note : ineffective_values(given, taken_.needs())) {
    if (note.is_refused) throw UsageError(note.text);
    sentences.push_back(std::move(note.text));
  }
  if (std::string left_out = left_out_note(); !left_out.empty()) sentences.push_back(std::move(left_out));
  for (const std::string& sentence : sentences)
    if (!into_.reporting.quiet) std::cerr << "meniscus: " << escaped(sentence) << std::endl;
}

/// Returns a note about values of the scene file that affect the picture but that this command, which shows the
/// molecule, does not show; empty if there are none.
std::string SceneOptions::left_out_note() const {
  if (!has_option(property_of("surface.color"))) return "";
  const auto has_any_of = [&](std::string_view section) {
    return std::ranges::any_of(properties(), [&](const Property* property) {
      return property->section() == section && has_option(*property);
    });
  };
  std::string names;
  for (const std::string& key : left_out_) {
    const std::string_view section = property_of(key).section();
    const bool is_seen = section == "annotations" || key == "frames.motion_blur" || key == "image.background" ||
                         (section == "legend" && key != shown_anyway_) ||
                         ((section == "look" || section == "camera") && has_any_of(section));
    if (is_seen) names += (names.empty() ? "" : ", ") + key;
  }
  return names.empty() ? ""
                       : fmt::format("note: {} ignores these values of the scene: {}", command_path(command_), names);
}

/// Makes a film of some seconds of a camera that turns around one molecule, unless the number of pictures is given.
void SceneOptions::turn_one_molecule() {
  Scene& scene = into_.scene;
  ModelChoice& model = scene.molecule.reading.model;
  if (!taken_.has("frames.codec") || scene.run_camera.turns == 0.0 || scene.frames.is_requested() || model.all) return;
  constexpr double kSeconds = 4.0;
  scene.frames.frames = fmt::format("{}", model.number - 1);
  scene.frames.repeat = static_cast<std::uint64_t>(std::max(std::lround(kSeconds * scene.film.frames_per_second), 2l));
  model.number = 1;
  if (!into_.reporting.quiet)
    std::cerr << fmt::format(
        "meniscus: note: --turntable turns around one molecule in {} pictures; --repeat N makes N\n",
        scene.frames.repeat);
}

void SceneOptions::check_table() const {
  const auto name = [](std::string_view key) { return std::string(property_of(key).long_option()); };
  for (const Property* property : properties()) {
    if (!has_option(*property) || !is_given(property->key)) continue;
    for (const std::string& other : parted(property->excluded))
      if (is_given(other) && has_option(property_of(other))) throw CLI::ExcludesError(name(property->key), name(other));
    if (!property->needed.empty() && has_option(property_of(property->needed)) && !is_given(property->needed))
      throw CLI::RequiresError(name(property->key), name(property->needed));
  }
}

void check_cost(const SceneCommand& command, const Scene& scene, glm::ivec2 size) {
  constexpr double kRaysPerHour = 6e9;  // per core, of a molecule that fills the picture
  const double rays = static_cast<double>(size.x) * size.y * scene.image.samples * scene.image.motion_blur;
  if (rays <= kMostRays || command.any_cost) return;
  throw UsageError(
      "{} x {} pixels with {} rays each are {:.2g} rays, about {:.3g} hours of one processor core; make the picture "
      "smaller (--size), take fewer rays (--samples), or add --any-cost",
      size.x, size.y, scene.image.samples * scene.image.motion_blur, rays, rays / kRaysPerHour);
}

SceneOutput::SceneOutput(const SceneCommand& command) : command_(command) {
  if (command.save_scene.empty()) return;
  if (command.scene.molecule.file == "-")
    throw UsageError("--save-scene: a scene names its molecule's file, which standard input is not");
  if (const std::string fault = scene_fault(command.scene); !fault.empty()) throw UsageError("--save-scene: " + fault);
  file_.emplace(command.save_scene, command.existing());
}

void SceneOutput::commit() {
  if (!file_) return;
  file_->write(scene_text_for(command_.scene, command_.save_scene, *command_.added));
  file_->commit();
}

std::string scene_text_for(const Scene& scene, const std::string& path, std::span<const AddedFile> added) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return scene_text(scene, folder.empty() ? "." : folder, added);
}

namespace {

/// Returns the scene in the description of a TIFF or JPEG picture, or in a page that readers turn; empty if there is
/// none. The text is that of scene_text(), in which only the last line begins with a brace. XML has a copy of the
/// description, with other letters for "<".
std::string carried_scene(const std::string& file) {
  constexpr std::string_view kFirst = "{\n  \"meniscus_scene\"", kLast = "\n}";
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const bool is_page = bytes.starts_with("<!");
  for (std::size_t at = 0; (at = bytes.find(kFirst, at)) != bytes.npos; ++at) {
    const std::size_t end = bytes.find(kLast, at);
    if (end == bytes.npos || (!is_page && at > 0 && bytes[at - 1] == '>')) continue;
    const std::string text = bytes.substr(at, end + kLast.size() - at);
    if (nlohmann::json::accept(text)) return text;
  }
  return {};
}

}  // namespace

std::string read_scene_text(const std::string& file) {
  constexpr std::size_t kLargestScene = std::size_t{16} << 20;  // bytes
  if (std::optional<std::string> scene = scene_of_storyboard(file)) return *std::move(scene);
  const std::string extension = std::filesystem::path(file).extension().string();
  constexpr std::string_view kCarriers[] = {".tif", ".tiff", ".jpg", ".jpeg", ".html"};
  const bool is_carrier = is_png(file) || std::ranges::find(kCarriers, extension) != std::end(kCarriers);
  std::string text = png_note(file, kSceneNote).value_or("");
  if (text.empty() && !is_png(file) && is_carrier) text = carried_scene(file);
  if (!text.empty()) return text;
  if (is_carrier)
    throw InputError(
        file, 0,
        "is a {} that carries no scene; pictures made with --no-provenance, frames of runs and pictures of "
        "other programs have none",
        extension == ".html" ? "page" : "picture");
  return std::string(read_text_file(file, kLargestScene).text);
}

std::string cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::string(cache) + "/meniscus";
  if (const char* home = std::getenv("HOME"); home && *home == '/') return std::string(home) + "/.cache/meniscus";
  return {};
}

}  // namespace meniscus
