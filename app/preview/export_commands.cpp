// SPDX-License-Identifier: BSD-3-Clause
// The commands that write and read files of the output folder: exports, scenes, the command line of a picture.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/film/film.h"
#include "app/options/property_options.h"
#include "app/preview/commands.h"
#include "app/preview/preview_state.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/properties/properties.h"
#include "core/render/image_output.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_paths.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr int kLongestExportedSide = 16384;  // pixels
constexpr int kMostSamples = 1024;           // as the property image.samples has it

/// The size and the quality of an exported picture.
struct PictureOptions {
  glm::ivec2 size;
  int samples;
  bool transparent;
};

PictureOptions picture_options(const CommandReader& command, const PreviewState& state) {
  const glm::ivec2 size = state.has_size ? state.picture.size() : state.size;
  return {{command.integer_or(size.x, "width", 16, kLongestExportedSide),
           command.integer_or(size.y, "height", 16, kLongestExportedSide)},
          command.integer_or(state.image.samples, "samples", 1, kMostSamples),
          command.flag_or(!state.image.background, "transparent")};
}

/// Throws RequestError for a name that is none, or of a file that is there and may not be replaced.
ExportTarget target_of(const CommandReader& command, const std::filesystem::path& folder) {
  ExportTarget target{export_path(folder, command.text("path")),
                      command.flag_or(false, "force") ? Existing::replace : Existing::refuse};
  if (target.existing == Existing::refuse && std::filesystem::exists(target.path))
    throw RequestError(target.path.string() + " exists already; allow replacing it, or give another name");
  return target;
}

enum class Format { png, povray, blender, film, camera, camera_path };  // the last two are written at once

/// A scene is a folder; so no file of another kind is replaced.
void check_ending(const std::string& name, Format format) {
  constexpr std::string_view kEndings[] = {"", "", ".mns", "", ".json", ".json"};
  if (format == Format::film && !is_film_path(name))
    throw RequestError(fmt::format("export: \"path\" is {}; a film's name must end in .mp4, .mov, .mkv, .webm or .gif",
                                   in_quotes(name)));
  if (format == Format::povray ? name.find('.') != std::string::npos
                               : !name.ends_with(kEndings[static_cast<std::size_t>(format)]))
    throw RequestError(fmt::format(
        "export: \"path\" is {}; {}", in_quotes(name),
        format == Format::povray ? "a scene is a folder, whose name has no dot"
                                 : fmt::format("its name must end in {}", kEndings[static_cast<std::size_t>(format)])));
}

/// The work of an export of what takes long.
Json written(const ExportedView& view, Format format, const MakePictureDevice& make_device, const ExportTarget& target,
             const ExportWatch& watch) {
  Json reply{{"path", target.path.string()}};
  if (format == Format::blender && (!view.figure.figure.plain() || (view.extras && !view.extras->empty())))
    reply["note"] = "without cuts and shapes beside the surface; meniscus export has options for these";
  if (format == Format::png) export_picture(view, make_device, target, watch);
  if (format == Format::povray) reply["render_with"] = export_povray(view, target, watch);
  if (format == Format::blender) export_blender(view, target, watch);
  return reply;
}

/// The scene of the film that a command requests: the run, or the molecule as it is, turned once around.
Scene film_scene(const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  const bool is_run = molecule.frame_count() > 1;
  if (is_run && state.follows_keys && !state.keys.empty())
    throw RequestError(
        "export: a film along the keys of a camera is made by meniscus render --camera-path; export them");
  constexpr double kTurnRate = 25.0, kTurnSeconds = 6.0, kLongest = 600.0;
  const PictureOptions options = picture_options(command, state);
  const glm::ivec2 even = 2 * (options.size / 2);  // as most encoders want it
  Scene scene = rendered_scene(state, {even, options.samples});
  scene.run_camera = {};
  scene.run_camera.turns = command.number_or(is_run ? 0.0 : 1.0, "turns", -100.0, 100.0);
  scene.film.frames_per_second = is_run ? state.frames_per_second : kTurnRate;
  const double seconds = command.number_or(kTurnSeconds, "seconds", 0.1, kLongest);
  if (!is_run) scene.frames.repeat = static_cast<std::uint64_t>(std::lround(kTurnRate * seconds));
  if (!molecule.has_trajectory()) scene.frames.frames = is_run ? "all" : "0";
  if (is_run && !molecule.has_trajectory()) scene.molecule.reading.model = {};
  return scene;
}

/// The scene of the picture that a command requests.
Scene shown_scene(const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  const PictureOptions options = picture_options(command, state);
  RenderedView view{options.size, options.samples, options.transparent};
  if (molecule.has_trajectory()) view.frame = molecule.number_of(state.frame);
  if (molecule.has_models()) {
    using By = ColorScheme::By;
    if (state.molecule.color.by == By::index || state.molecule.color.by == By::radial)
      throw RequestError(
          fmt::format("{}: {} counts the atoms of all models here, and those of one in a picture by "
                      "render; choose another scheme",
                      command.word(), in_quotes(scheme_word(state.molecule.color))));
    view.model = molecule.structure().atoms[molecule.atoms().front()].model;
    // A model alone would have a scale of its own.
    if (state.molecule.color.has_scale() && !(state.molecule.color.takes_file() && state.molecule.color.file.of_colors))
      view.range = color_scale(molecule.structure(), state.molecule.color).range;
  }
  return rendered_scene(state, view);
}

/// The same as the text that pictures carry; empty where there is none.
std::string scene_of(const CommandReader& command, const Surroundings& around) {
  if (!around.exporter.context.writes_scenes || around.molecule.has_trajectory())
    return {};  // frames of a run carry none
  try {
    const Scene scene = shown_scene(command, around);
    return scene_fault(scene).empty() ? scene_text(scene, "", around.molecule.structure().added) : "";
  } catch (const RequestError&) {
    return {};  // render cannot make this view
  }
}

}  // namespace

Json export_view(const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  Exporter& exporter = around.exporter;
  const auto format =
      static_cast<Format>(command.choice("format", {"png", "povray", "blender", "film", "camera", "camera_path"}));
  check_ending(command.text("path"), format);
  const bool waits = command.flag_or(true, "wait");
  if (exporter.job && exporter.job->running())
    throw RequestError("export: " + exporter.job->state()["path"].get<std::string>() +
                       " is being written; wait for it, or cancel it");
  const ExportTarget target = target_of(command, exporter.folder);
  const PictureOptions options = picture_options(command, state);
  if (format == Format::png) check_image_path(target.path);
  if (format == Format::camera) export_camera(state.camera, target);
  if (format == Format::camera_path) export_camera_path(camera_keys(molecule, state), target);
  if (format >= Format::camera) return {{"path", target.path.string()}};
  exporter.forget_job();
  const auto begin = [&](ExportJob::Work work, std::optional<std::uint64_t> edition) {
    exporter.job_edition = edition;
    exporter.job = std::make_unique<ExportJob>(target.path.string(), std::move(work));
    return waits ? exporter.job->result() : Json{{"path", target.path.string()}, {"running", true}};
  };
  if (format == Format::film) {
    if (!exporter.context.make_film) throw RequestError("export: this preview makes no films");
    const auto make = [scene = film_scene(command, around), target,
                       make = exporter.context.make_film](const ExportWatch& watch) {
      make(scene, target, watch);
      return Json{{"path", target.path.string()}};
    };
    return begin(make, {});
  }
  const MakePictureDevice& make_device = exporter.context.make_device;
  Annotations annotations =
      annotations_of(state.annotations, molecule.annotated_structure(),
                     molecule.extras() ? molecule.extras()->lengths() : std::vector<PlaceLabel>());
  Coloring coloring = molecule.coloring(state);
  coloring.in_patch = molecule.patch_marks(state);
  auto view = std::make_shared<const ExportedView>(
      ExportedView{molecule.structure(), molecule.atoms(), molecule.balls(), std::move(coloring), molecule.key(state),
                   state, molecule.extras(), std::move(annotations), options.size, options.samples, options.transparent,
                   format == Format::png ? scene_of(command, around) : ""});
  const auto write = [view, target, format, make_device](const ExportWatch& watch) {
    return written(*view, format, make_device, target, watch);
  };
  return begin(write, view->scene.empty() ? std::nullopt : std::optional(state.edition));
}

Json export_state(const CommandReader&, const Surroundings& around) {
  return around.exporter.job ? around.exporter.job->state() : Json{{"running", false}};
}

Json cancel_export(const CommandReader&, const Surroundings& around) {
  const std::unique_ptr<ExportJob>& job = around.exporter.job;
  if (!job || !job->running()) throw RequestError("cancel_export: nothing is being written");
  job->cancel();
  return Json::object();
}

Json get_scene(const CommandReader& command, const Surroundings& around) {
  return {{"text", scene_of(command, around)}};
}

Json render_command(const CommandReader& command, const Surroundings& around) {
  const std::vector<std::string> words = render_words(shown_scene(command, around));
  return {{"words", words}, {"text", shell_line(words)}};
}

Json save_scene(const CommandReader& command, const Surroundings& around) {
  const Exporter& exporter = around.exporter;
  if (!exporter.context.writes_scenes) throw RequestError("save: this preview writes no scenes");
  const std::string name = command.text("path");
  if (!name.ends_with(".json"))
    throw RequestError(fmt::format("save: \"path\" is {}; a scene's name must end in .json", in_quotes(name)));
  const ExportTarget target = target_of(command, exporter.folder);
  const Scene scene = shown_scene(command, around);
  if (const std::string fault = scene_fault(scene); !fault.empty()) throw RequestError("save: " + fault);
  OutputFile file(target.path, target.existing);
  file.write(scene_text(scene, target.path.parent_path().string(), around.molecule.structure().added));
  file.commit();
  around.exporter.saved = around.state.edition;
  return {{"path", target.path.string()}};
}

Outcome open_scene(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const ShownMolecule& molecule = around.molecule;
  const Exporter& exporter = around.exporter;
  if (!exporter.context.open_scene) throw RequestError("open: this preview reads no scenes");
  const std::string name = command.text("path");
  OpenedScene opened = exporter.context.open_scene(export_path(exporter.folder, name));
  const ColorScheme& first = around.first.molecule.color;
  ColorScheme& color = opened.figure.molecule.color;
  if (color.by == ColorScheme::By::rmsf && color.by == first.by) color.file = first.file;
  require_previewed(color);
  static_cast<PreviewFigure&>(state) = std::move(opened.figure);
  require_copies_apart(molecule.structure(), state, around.state.probe_reach());
  if (molecule.has_models()) state.frame = static_cast<std::size_t>(opened.frame);
  if (state.frame >= molecule.frame_count())
    throw RequestError(fmt::format("open: {} is of a model that is not there", name));
  const Renewal renewal = state.frame == around.state.frame ? Renewal::shapes : Renewal::frame;
  Outcome next{std::move(state), renewal, {{"path", (exporter.folder / name).string()}}, true};
  next.is_saved = true;
  return next;
}

}  // namespace meniscus
