// SPDX-License-Identifier: BSD-3-Clause
// Options of the preview, and the scenes that it reads again, opens and makes films of.
#include "app/commands/preview_command.h"

#include <charconv>
#include <sstream>

#include <CLI/CLI.hpp>
#include "app/process/child_process.h"
#include "app/process/program_main.h"
#include "core/base/system_file.h"
#include "core/scene/scene_picture.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

/// Parses "PORT" or "ADDRESS:PORT"; empty: any port.
void parse_port(const std::string& text, PreviewCommand& command) {
  command.port = 0;
  if (text.empty()) return;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) command.address = text.substr(0, colon);
  const char* const begin = text.data() + (colon == std::string::npos ? 0 : colon + 1);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), *command.port);
  if (error != std::errc() || end != text.data() + text.size())
    throw CLI::ValidationError("--serve", in_quotes(text) + " is not a port from 0 to 65535; put FILE before --serve");
}

}  // namespace

MoleculeRequest PreviewCommand::read_molecule_request() const {
  MoleculeRequest molecule = scene.molecule;
  molecule.reading.model.all = models;
  return molecule;
}

TakenProperties preview_properties() {
  return render_properties().with({"-surface.interface", "-surface.by",
                                   "-surface.cavities",  "-surface.threads",
                                   "-surface.verify",    "-frames.only",
                                   "-frames.progress",   "-Film",
                                   "-camera.path",       "-camera.turntable",
                                   "-camera.follow",     "-camera.save",
                                   "-image.aovs",        "-image.cryptomatte",
                                   "-image.color_space", "-image.extent",
                                   "-image.margin",      "-image.tiff_compression",
                                   "-image.tiff_bits",   "-picture.any_cost",
                                   "-legend.file",       "-annotations.time_stamp",
                                   "-annotations.curve", "-annotations.curve_column",
                                   "-output.file",       "-scene.save"},
                                  {{{"output.force"}, {"preview.record"}, "it is only for --record"}});
}

void add_preview_options(CLI::App& command, DeclaredPreview& declared) {
  SceneOptions& shared = declared.options;
  shared.be_live();
  shared.option("molecule.model")->description("Model to show; default: all of them, each a frame");
  shared.option("image.samples")->description("Rays per pixel of exported pictures [4; of scenes 9]");
  shared.option("image.background")
      ->description("A colour (white, grey, #rrggbb), or transparent in exported pictures [white]");
  PropertyOptions options(command);
  PreviewCommand& state = declared.state;
  options.add_parsed("preview.serve", [&state](const std::string& text) { parse_port(text, state); });
  options.add("preview.trusted_hosts", state.trusted_hosts);
  options.add("preview.no_open", state.no_open);
  options.add("preview.token_file", state.token_file);
  options.add("preview.commands", state.commands);
  options.add("preview.record", state.record);
  options.add("preview.output_folder", state.output_folder);
}

void take_preview(DeclaredPreview& declared, const std::vector<std::string>& named) {
  SceneOptions& options = declared.options;
  options.take(named);
  PreviewCommand& state = declared.state;
  Scene& scene = state.scene;
  require_probe_of_kind(scene.molecule.surface);
  const bool is_scene = !options.file().empty();
  if (scene.picture.fits && !is_scene) throw UsageError("--size auto and --height auto are for render; give a size");
  if (!is_scene && !options.is_given("image.background")) scene.image.background = glm::vec3(1.0f);
  state.models = !is_scene && !options.is_given("molecule.model") && !scene.frames.is_requested() &&
                 scene.molecule.reading.added.empty();
  state.aims = is_scene || scene.picture.direction || scene.picture.zoom_to || !scene.picture.turns.empty();
  state.has_size =
      is_scene || options.is_given("image.size") || options.is_given("image.width") || options.is_given("image.height");
  if (!is_scene && !options.is_given("image.samples")) scene.image.samples = PreviewFigure().image.samples;
}

namespace {

/// Returns the value of a property, with paths normalized.
std::vector<std::string> normalized_texts(const Scene& scene, const Property& property) {
  std::vector<std::string> texts = value_texts(scene, property);
  if (property.type == ValueType::file)
    for (std::string& path : texts) path = std::filesystem::weakly_canonical(path).string();
  return texts;
}

}  // namespace

ShownReader::ShownReader(const PreviewCommand& command)
    : molecule_(command.scene.molecule), frames_(command.scene.frames), models_(command.models) {}

Structure ShownReader::operator()(const FigureRequest& figure, std::size_t frame) const {
  if (molecule_.file == "-")
    throw RequestError(
        "a molecule from standard input cannot be read again; give FILE to draw atoms in addition to the surface");
  MoleculeRequest wanted = molecule_;
  figure.mark_atoms(wanted.reading);
  if (models_) {
    wanted.reading.model = {};
    wanted.reading.model.number = static_cast<int>(frame) + 1;
  }
  if (!frames_.is_requested()) return read_molecule(wanted);
  std::string marks = wanted.reading.secondary_structure ? "secondary" : "";
  for (const ShownAtoms& shown : wanted.reading.shown)
    marks += fmt::format("\n{} {} {}", shown.option, shown.each_is_drawn, shown.atoms.text());
  marks += fmt::format("\n{}", wanted.reading.companions == Companions::drawn);
  if (!open_->run || open_->marks != marks) {
    open_->run = std::make_unique<FrameRun>(wanted, frames_);
    open_->marks = std::move(marks);
  }
  return open_->run->at(open_->run->chunk()[frame]);
}

Camera aimed_camera(const Scene& scene, const std::optional<Camera>& given, const Structure& structure) {
  const ColorScheme& color = scene.molecule.color;
  ViewRequest layout = scene.picture;
  if (scene.legend.within) {
    const ColorKey colors = figure_key(structure, color, {std::vector<bool>(structure.atoms.size(), true)},
                                       scene.figure, make_extras(structure, scene.figure, color));
    const Legend legend(colors, layout.size(), legend_style(scene.legend.style, scene.annotations.letters));
    layout.width = legend.molecule_size().x;
    layout.height = legend.molecule_size().y;
  }
  const Strips strips = scene_strips(scene, layout.size());
  layout.height -= strips.top + strips.bottom;
  // Framing needs only atoms and their copies.
  const SurfaceRequest& surface = scene.molecule.surface;
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
  const ViewAim aim(layout, scene.molecule.show, structure);
  return aim.camera(layout, given, aim.viewed(objects));
}

void make_film(const FilmOrder& order, const ExportTarget& target, const ExportWatch& watch) {
  using namespace std::chrono_literals;
  using Json = nlohmann::json;
  check_output(target.path, target.existing);
  std::vector<std::string> words = order.words;
  words.front() = system_file::program_path().string();
  std::optional<OutputFile> storyboard;  // it is never committed, so that it is deleted with this object
  if (order.storyboard.empty()) {
    words.insert(words.end(), {"-q", "--progress", "json"});
  } else {
    storyboard.emplace(target.path.string() + ".json", Existing::replace);
    storyboard->write(order.storyboard);
    words.push_back(storyboard->temporary_path().string());
  }
  if (target.existing == Existing::replace) words.emplace_back("--force");
  const StopHandler handler([] { stop_children(); }, std::nullopt);
  ChildProcess child(words, ".");
  std::uint64_t frames = 0, done = 0;
  std::string fault = "the film was not made";
  try {
    for (;;) {
      const double share = static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(frames, 1));
      watch(frames ? fmt::format("frame {} of {}", done, frames).c_str() : "reading", share);
      if (!child.has_news(100ms)) continue;
      const std::optional<std::string> line = child.next_line();
      if (!line) break;
      if (line->starts_with("film: ")) {
        std::string word;
        std::istringstream(*line) >> word >> done >> word >> frames;
        continue;
      }
      const Json event = Json::parse(*line, nullptr, false);
      if (!event.is_object()) fault = *line;
      if (!event.is_object()) continue;
      if (event.value("event", "") == "start") frames = event.value("frames", frames);
      if (event.value("event", "") != "frame") continue;
      ++done;
      fault = event.value("error", fault);
    }
  } catch (...) {
    child.stop();  // the child removes its incomplete file
    while (child.next_line()) {
    }
    child.wait();
    throw;
  }
  constexpr std::string_view kPrefix = "meniscus: error: ";
  if (child.wait() != 0)
    throw RequestError("export: " + (fault.starts_with(kPrefix) ? fault.substr(kPrefix.size()) : fault));
}

SceneOpener::SceneOpener(const DeclaredPreview& begun) : begun_(begun.state.scene), models_(begun.state.models) {
  const CLI::App& command = begun.options.command();
  if (command.count("--trust-scene") > 0) named_.emplace_back("--trust-scene");
  for (const CLI::Option* option : command.get_options())
    named_.insert(named_.end(), option->results().begin(), option->results().end());
}

bool SceneOpener::is_of_this_molecule(const Scene& scene) const {
  return std::ranges::all_of(properties(), [&](const Property* property) {
    if (!property->has(in_scene) || (models_ && property->key == "molecule.model")) return true;
    const bool reads = property->section() == "molecule" || property->section() == "frames";
    // These properties of surfaces are the files of colours.
    const bool colors =
        property->section() == "surface" && (property->type == ValueType::file || property->name() == "color_column");
    if (!reads && !colors) return true;
    const std::vector<std::string> own = normalized_texts(scene, *property);
    return (colors && own.empty()) || own == normalized_texts(begun_, *property);
  });
}

OpenedScene SceneOpener::operator()(const std::filesystem::path& path) const {
  CLI::App app("", "preview");
  DeclaredPreview declared(app, preview_properties());
  declared.options.name_file(path.string());
  declared.state.reporting.quiet = true;
  try {
    take_preview(declared, named_);
  } catch (const SelectionError& error) {
    throw RequestError(error.sentence());
  } catch (const CLI::Error& error) {
    throw RequestError(error.what());
  }
  PreviewCommand& opened = declared.state;
  if (!is_of_this_molecule(opened.scene))
    throw RequestError(
        "open: {} has other atoms, frames or numbers than {}, which is shown; start another preview with --scene",
        escaped(path.string()), escaped(begun_.molecule.file));
  Scene& shown = opened.scene;
  shown.molecule.color = color_of(shown.molecule);
  OpenedScene scene{PreviewFigure(shown)};
  PreviewFigure& figure = scene.figure;
  figure.camera = aimed_camera(shown, given_camera(shown.picture), ShownReader(opened)(shown.figure, 0));
  figure.overview = false;
  figure.has_size = true;
  // The molecule is read, and surfaces are computed, as before.
  const MoleculeRequest asked = std::exchange(figure.molecule, begun_.molecule);
  figure.molecule.surface.kind = asked.surface.kind;
  figure.molecule.surface.probe_radius = asked.surface.probe_radius;
  figure.molecule.show = asked.show;
  figure.molecule.patches = asked.patches;
  figure.molecule.least_patch = asked.least_patch;
  figure.molecule.color = asked.color;
  figure.frames = begun_.frames;
  if (models_) scene.frame = shown.molecule.reading.model.number - 1;
  return scene;
}

}  // namespace meniscus
