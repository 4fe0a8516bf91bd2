// SPDX-License-Identifier: BSD-3-Clause
// Molecules read again for a figure, cameras aimed as render aims them, scenes saved and opened.
#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/preview_command.h"
#include "app/options/scene_file.h"
#include "core/properties/properties.h"
#include "app/options/usage_faults.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/surface_kind.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// Parses words of a command line, the first that of `command`, without doing what they say.
void parse_only(CLI::App& program, CLI::App& command, std::vector<std::string> words) {
  command.callback([] {});
  std::ranges::reverse(words);
  program.parse(words);
}

/// Does something with the command `render` whose options are these words.
void with_render(const std::vector<std::string>& words, const std::function<void(const CLI::App& render)>& use) {
  CLI::App program("", words.front());
  let_the_last_count(program);
  CLI::App& render = *program.add_subcommand(words.at(1));
  add_render(render);
  parse_only(program, render, {words.begin() + 1, words.end()});
  use(render);
}

}  // namespace

ShownReader::ShownReader(const PreviewCommand& command, bool models)
    : molecule_(command.molecule), frames_(command.frames), models_(models && !command.frames.asked()) {}

Structure ShownReader::operator()(const FigureRequest& figure, std::size_t frame) const {
  if (molecule_.file == "-")
    throw RequestError("a molecule from standard input cannot be read again; give FILE to draw atoms beside a surface");
  MoleculeOptions wanted = molecule_;
  figure.ask_for(wanted.reading);
  if (!frames_.asked()) {
    if (models_) {
      wanted.reading.model = {};
      wanted.reading.model.number = static_cast<int>(frame) + 1;
    }
    return read_molecule(wanted);
  }
  if (wanted.reading.model.all) wanted.reading.model = {};
  FrameRun run(wanted, frames_);
  return run.at(run.chunk()[frame]);
}

Camera aimed_camera(const PreviewCommand& command, const std::optional<Camera>& given, const ColorScheme& color,
                    const Structure& structure) {
  ViewRequest layout = command.picture;
  if (command.legend.within && (color.by != ColorScheme::By::fixed || !color.rules.empty())) {
    const std::string names[] = {"surface"};
    const Legend legend(color_key(structure, color, names), layout.size(), command.legend.style);
    layout.width = legend.molecule_size().x;
    layout.height = legend.molecule_size().y;
  }
  // Framing needs atoms and their copies alone.
  const SurfaceRequest& surface = command.molecule.surface;
  const std::vector<Ball> balls = grown(balls_of(structure), growth_of(surface.kind, surface.probe_radius));
  std::vector<SurfaceObject> objects;
  const auto add = [&](const std::vector<std::uint32_t>& atoms) -> SurfaceObject& {
    SurfaceObject& object = objects.emplace_back();
    for (const std::uint32_t atom : atoms) object.surface.atoms.push_back(balls[atom]);
    object.atom = atoms;
    return object;
  };
  for (const Instances& group : structure.instances) add(group.atoms).copies = group.motions;
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  if (objects.empty()) add(all);
  return ViewAim(layout, command.molecule.show, structure).camera(layout, given, objects);
}

void save_render_scene(const std::vector<std::string>& words, const ExportTarget& target) {
  with_render(words, [&](const CLI::App& render) {
    SceneOutput scene(render, target.path.string(), target.existing);
    scene.commit();
  });
}

std::string render_scene_text(const std::vector<std::string>& words) {
  std::string text;
  with_render(words, [&](const CLI::App& render) { text = scene_text(render, ""); });
  return text;
}

SceneOpener::SceneOpener(const CLI::App& parsed, const PreviewCommand& command)
    : molecule_(reading_of(parsed, {"molecule", "frames"})),
      numbers_(reading_of(parsed, {"surface"})),
      shows_models_(command.molecule.reading.model.all && !command.frames.asked()),
      file_(command.molecule.file) {
  if (parsed.count("--trust-scene") > 0) named_.emplace_back("--trust-scene");
  for (const CLI::Option* option : parsed.get_options())
    for (const std::string& value : option->results()) named_.push_back(value);
}

std::vector<SceneOpener::Reading> SceneOpener::reading_of(const CLI::App& parsed,
                                                          std::initializer_list<std::string_view> sections) {
  std::vector<Reading> readings;
  for (const Property* property : properties()) {
    if (!property->has(in_scene) || std::ranges::find(sections, property->section()) == sections.end()) continue;
    const bool is_file = property->type == ValueType::file;
    // Of surfaces the files that they are coloured by.
    if (property->section() == "surface" && !is_file && property->name() != "color_column") continue;
    const CLI::Option* const option = parsed.get_option_no_throw(std::string(property->option));
    if (!option || option->empty()) continue;
    Reading reading{std::string(property->option), option->results()};
    if (is_file)
      for (std::string& path : reading.values) path = fs::weakly_canonical(path).string();
    readings.push_back(std::move(reading));
  }
  return readings;
}

OpenedScene SceneOpener::operator()(const fs::path& path) const {
  CLI::App program("", "meniscus");
  let_the_last_count(program);
  CLI::App& parsed = *program.add_subcommand("preview");
  PreviewCommand command;
  declare_preview(parsed, command);
  const SceneWords scene = with_scene(program, {"preview", "--scene", path.string()}, named_);
  try {
    parse_only(program, parsed, scene.words);
  } catch (const SelectionError& error) {
    throw RequestError(scene.name_key(error.sentence()));
  } catch (const CLI::ParseError& error) {
    throw RequestError(scene.name_key(error.what()));
  }
  take_preview(parsed, command);

  std::vector<Reading> own = reading_of(parsed, {"molecule", "frames"}), shown = molecule_;
  const auto is_model = [](const Reading& reading) { return reading.option == "--model"; };
  if (shows_models_)
    for (std::vector<Reading>* readings : {&own, &shown}) std::erase_if(*readings, is_model);
  const std::vector<Reading> numbers = reading_of(parsed, {"surface"});
  if (own != shown || (!numbers.empty() && numbers != numbers_))
    throw RequestError(fmt::format(
        "open: {} is of other atoms, frames or numbers than {}, which is shown; begin another preview with --scene",
        escaped(path.string()), escaped(file_)));

  const ColorScheme color = color_of(command.molecule);
  OpenedScene opened{figure_of(command, color), wishes_of(command, parsed), 0};
  opened.figure.camera = aimed_camera(command, given_camera(command.picture), color,
                                      ShownReader(command, command.molecule.reading.model.all)(command.figure, 0));
  opened.figure.overview = false;
  if (shows_models_) opened.frame = command.molecule.reading.model.number - 1;
  return opened;
}

}  // namespace meniscus
