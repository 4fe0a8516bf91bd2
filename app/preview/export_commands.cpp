// SPDX-License-Identifier: BSD-3-Clause
// Commands that write and read files of the output folder: exports, scenes, and the command line of a picture.

#include "app/film/film.h"
#include "app/options/named_files.h"
#include "app/options/property_options.h"
#include "app/preview/commands.h"
#include "app/preview/preview_state.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera_json.h"
#include "core/color/color_schemes.h"
#include "core/properties/properties.h"
#include "core/render/image_output.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr int kLongestExportedSide = 16384;  // pixels
constexpr int kMostSamples = 1024;           // the limit of the property image.samples

/// Returns the size and the quality of an exported picture.
RenderedView picture_options(const CommandReader& command, const PreviewState& state) {
  const glm::ivec2 size = state.has_size ? state.picture.size() : state.size;
  return {{command.integer_or(size.x, "width", 16, kLongestExportedSide),
           command.integer_or(size.y, "height", 16, kLongestExportedSide)},
          command.integer_or(state.image.samples, "samples", 1, kMostSamples),
          command.flag_or(!state.image.background, "transparent")};
}

/// Returns the target of an export. Throws RequestError for a bad name, or if an existing file may not be replaced.
ExportTarget target_of(const CommandReader& command, const std::filesystem::path& folder) {
  ExportTarget target{export_path(folder, command.text("path")),
                      command.flag_or(false, "force") ? Existing::replace : Existing::refuse};
  if (target.existing == Existing::refuse && std::filesystem::exists(target.path))
    throw RequestError(target.path.string() + " exists already; allow replacing it, or give another name");
  return target;
}

enum class Format { png, povray, blender, film, camera, camera_path };  // camera and camera_path are written at once

/// Throws RequestError if a name has another ending than its format. A scene is a folder, so its name has no dot.
void check_ending(const std::string& name, Format format) {
  constexpr std::string_view kEndings[] = {"", "", ".mns", "", ".json", ".json"};
  if (format == Format::film && !is_film_path(name))
    throw RequestError("export: \"path\" is {}; a film's name must end in .mp4, .mov, .mkv, .webm or .gif",
                       in_quotes(name));
  if (format == Format::povray ? name.find('.') != std::string::npos
                               : !name.ends_with(kEndings[static_cast<std::size_t>(format)]))
    throw RequestError("export: \"path\" is {}; {}", in_quotes(name),
                       format == Format::povray
                           ? "a scene is a folder, whose name has no dot"
                           : fmt::format("its name must end in {}", kEndings[static_cast<std::size_t>(format)]));
}

/// Writes an export that takes long and returns its reply.
Json written(const ExportedView& view, Format format, bool archives, const MakePictureDevice& make_device,
             const ExportTarget& target, const ExportWatch& watch) {
  Json reply{{"path", target.path.string()}};
  const std::string archive = archives && format == Format::povray ? target.path.string() + ".zip" : "";
  if (!archive.empty()) reply["archive"] = archive;
  if (format == Format::blender && (!view.figure.figure.plain() || (view.extras && !view.extras->empty())))
    reply["note"] = "without cuts and shapes beside the surface; meniscus export has options for these";
  if (format == Format::png) export_picture(view, make_device, target, watch);
  if (format == Format::povray) reply["render_with"] = export_povray(view, target, archive, watch);
  if (format == Format::blender) export_blender(view, target, watch);
  return reply;
}

enum class FilmOf { strip, turntable, frames };
constexpr std::array<std::string_view, 3> kFilms{"strip", "turntable", "frames"};
constexpr double kFilmRate = 25.0;  // pictures per second, the default of --fps

/// Returns the films that can be made of the preview; the first is the default.
std::vector<FilmOf> possible_films(const Surroundings& around) {
  std::vector<FilmOf> films;
  if (around.state.strip.size() > 1) films.push_back(FilmOf::strip);
  if (around.molecule.frame_count() > 1) films.push_back(FilmOf::frames);
  films.push_back(FilmOf::turntable);
  return films;
}

/// Returns the number of pictures of a film.
std::uint64_t pictures_of(FilmOf film, const CommandReader& command, const Surroundings& around) {
  constexpr double kTurnSeconds = 6.0, kLongest = 600.0;
  if (film == FilmOf::frames) return around.molecule.frame_count();
  if (film == FilmOf::turntable)
    return static_cast<std::uint64_t>(
        std::lround(kFilmRate * command.number_or(kTurnSeconds, "seconds", 0.1, kLongest)));
  const std::vector<KeptScene>& strip = around.state.strip;
  std::uint64_t count = 0;
  for (const KeptScene& kept : strip) count += kept.held(kFilmRate) + kept.between(kFilmRate);
  return count - strip.back().between(kFilmRate);
}

/// Returns the size of a film's pictures, which is even, because most encoders need that.
glm::ivec2 film_size(const RenderedView& options) { return 2 * (options.size / 2); }

/// Sets the frames of a scene to one frame of the trajectory. number: ShownMolecule::number_of().
void show_one_frame(Scene& scene, std::uint64_t number) {
  if (scene.frames.interpolate > 1)
    throw RequestError("export: a film cannot hold a frame between two of the trajectory; leave --interpolate out");
  scene.frames.frames = fmt::format("{}", number / scene.frames.repeat);
  scene.frames.repeat = scene.frames.stride = 1;
  scene.frames.begin = scene.frames.end = scene.frames.only = "";
}

/// Returns the scene of a turntable or of a film of the frames.
Scene film_scene(FilmOf film, const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  const bool is_run = film == FilmOf::frames;
  if (is_run && state.follows_keys && !state.keys.empty())
    throw RequestError(
        "export: a film along the keys of a camera is made by meniscus render --camera-path; export them");
  const RenderedView options = picture_options(command, state);
  Scene scene = rendered_scene(state, {film_size(options), options.samples});
  scene.run_camera = {};
  scene.run_camera.turns = command.number_or(is_run ? 0.0 : 1.0, "turns", -100.0, 100.0);
  scene.film.frames_per_second = is_run ? state.frames_per_second : kFilmRate;
  if (is_run && !molecule.has_trajectory()) scene.frames.frames = "all";
  if (!is_run) {
    show_one_frame(scene, molecule.number_of(state.frame));
    scene.frames.repeat = pictures_of(film, command, around);
  }
  if (molecule.has_models()) scene.molecule.reading.model = {};
  return scene;
}

/// Returns the scene of the picture that a command requests.
Scene shown_scene(const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  RenderedView view = picture_options(command, state);
  if (molecule.has_trajectory()) view.frame = molecule.number_of(state.frame);
  if (molecule.has_models()) {
    using By = ColorScheme::By;
    if (state.molecule.color.by == By::index || state.molecule.color.by == By::radial)
      throw RequestError(
          "{}: {} counts the atoms of all models here, and those of one in a picture by "
          "render; choose another scheme",
          command.word(), in_quotes(scheme_word(state.molecule.color)));
    view.model = molecule.model_of(state.frame);
    // One model alone would have its own range of numbers.
    if (state.molecule.color.has_scale() && !(state.molecule.color.takes_file() && state.molecule.color.file.of_colors))
      view.range = color_scale(molecule.structure(), state.molecule.color).range;
  }
  return rendered_scene(state, view);
}

/// Returns the scenes of the strip as a storyboard file. folder: paths are relative to it.
std::string strip_text(const CommandReader& command, const Surroundings& around, const std::string& folder) {
  StoryboardFile story;
  for (const KeptScene& kept : around.state.strip) {
    PreviewState state = around.state;
    static_cast<PreviewFigure&>(state) = kept.figure;
    state.picture = around.state.picture;
    state.has_size = around.state.has_size;
    state.frame = kept.frame;
    const Surroundings then{state, around.first, around.history, around.molecule, around.pictures, around.exporter};
    Scene scene = shown_scene(command, then);
    const glm::ivec2 size = film_size(picture_options(command, state));
    scene.picture.width = size.x;
    scene.picture.height = size.y;
    scene.image.background = kept.figure.shown_background();
    scene.output.clear();
    if (around.molecule.has_trajectory()) show_one_frame(scene, around.molecule.number_of(kept.frame));
    if (const std::string fault = scene_fault(scene); !fault.empty())
      throw RequestError("{}: {}", command.word(), fault);
    story.scenes.push_back(scene_text(scene, folder, around.molecule.structure().added));
    story.hold.push_back(kept.hold);
    story.transition.push_back(kept.transition);
  }
  story.transition.pop_back();  // the last scene has no transition
  return storyboard_text(story);
}

/// Returns what makes the film that a command requests.
FilmOrder film_order(const CommandReader& command, const Surroundings& around, const ExportTarget& target) {
  const std::vector<FilmOf> films = possible_films(around);
  const FilmOf film =
      command.has("of") ? static_cast<FilmOf>(command.choice("of", {kFilms.begin(), kFilms.end()})) : films.front();
  if (std::ranges::find(films, film) == films.end())
    throw RequestError(film == FilmOf::strip ? "export: a film of the strip needs two scenes or more; keep them first"
                                             : "export: there is one frame; choose a turntable");
  if (around.state.molecule.file == "-")
    throw RequestError("export: a molecule from standard input cannot be read again; give FILE to make a film");
  if (film != FilmOf::strip) {
    Scene scene = film_scene(film, command, around);
    scene.output = target.path.string();
    return {render_words(scene), {}};
  }
  FilmOrder order{{"meniscus", "film", "--trust-scene", "-o", target.path.string()},
                  strip_text(command, around, target.path.parent_path().string())};
  const Property& device = property_of("surface.device");
  for (const std::string& text : value_texts(around.state, device))
    order.words.insert(order.words.end(), {std::string(device.long_option()), text});
  return order;
}

/// Returns the text of the scene that pictures carry; empty if there is none.
std::string scene_of(const CommandReader& command, const Surroundings& around) {
  if (!around.exporter.context.writes_scenes || around.molecule.has_trajectory())
    return {};  // frames of a trajectory carry no scene
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
  const RenderedView options = picture_options(command, state);
  if (format == Format::png) check_image_path(target.path);
  if (format >= Format::camera) {
    const std::vector<CameraKey> keys = camera_keys(molecule, state);
    if (format == Format::camera_path && keys.empty())
      throw RequestError("export: the camera has no keys yet; set some, each at a frame");
    OutputFile file(target.path, target.existing);
    file.write(format == Format::camera ? camera_json(state.camera) : camera_path_json(keys));
    file.commit();
    Exporter::add_once(exporter.written, target.path);
    return {{"path", target.path.string()}};
  }
  exporter.forget_job();
  const auto begin = [&](ExportJob::Work work, std::optional<std::uint64_t> edition) {
    exporter.job_edition = edition;
    exporter.job = std::make_unique<ExportJob>(target.path.string(), std::move(work));
    return waits ? exporter.job->result() : Json{{"path", target.path.string()}, {"running", true}};
  };
  if (format == Format::film) {
    if (!exporter.context.make_film) throw RequestError("export: this preview makes no films");
    exporter.keep_files();
    const auto make = [order = film_order(command, around, target), target,
                       make = exporter.context.make_film](const ExportWatch& watch) {
      make(order, target, watch);
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
  if (!view->scene.empty()) exporter.keep_files();
  const auto write = [view, target, format, archives = command.flag_or(false, "archive"),
                      make_device](const ExportWatch& watch) {
    return written(*view, format, archives, make_device, target, watch);
  };
  return begin(write, view->scene.empty() ? std::nullopt : std::optional(state.edition));
}

Json get_films(const CommandReader& command, const Surroundings& around) {
  const glm::ivec2 size = film_size(picture_options(command, around.state));
  Json films = Json::array();
  for (const FilmOf film : possible_films(around)) {
    const std::uint64_t pictures = pictures_of(film, command, around);
    const double rate = film == FilmOf::frames ? around.state.frames_per_second : kFilmRate;
    films.push_back({{"of", kFilms.at(static_cast<std::size_t>(film))},
                     {"pictures", pictures},
                     {"seconds", static_cast<double>(pictures) / rate}});
  }
  return {{"films", films}, {"width", size.x}, {"height", size.y}};
}

Json export_state(const CommandReader&, const Surroundings& around) {
  const Exporter& exporter = around.exporter;
  Json reply = exporter.job ? exporter.job->state() : Json{{"running", false}};
  reply["written"] = Json::array();
  for (const std::filesystem::path& path : exporter.written_paths())
    reply["written"].push_back(
        {{"name", path.filename().string()}, {"path", path.string()}, {"folder", std::filesystem::is_directory(path)}});
  return reply;
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
  around.exporter.keep_files();
  return {{"words", words}, {"text", shell_line(words)}};
}

Json save_scene(const CommandReader& command, const Surroundings& around) {
  const Exporter& exporter = around.exporter;
  if (!exporter.context.writes_scenes) throw RequestError("save: this preview writes no scenes");
  const std::string name = command.text("path");
  if (!name.ends_with(".json"))
    throw RequestError("save: \"path\" is {}; a scene's name must end in .json", in_quotes(name));
  const ExportTarget target = target_of(command, exporter.folder);
  const std::string folder = target.path.parent_path().string();
  const bool is_strip = command.flag_or(false, "strip");
  if (is_strip && around.state.strip.empty()) throw RequestError("save: no scene is kept");
  const Scene scene = shown_scene(command, around);
  if (const std::string fault = scene_fault(scene); !fault.empty()) throw RequestError("save: " + fault);
  around.exporter.keep_files();
  OutputFile file(target.path, target.existing);
  file.write(is_strip ? strip_text(command, around, folder)
                      : scene_text(scene, folder, around.molecule.structure().added));
  file.commit();
  Exporter::add_once(around.exporter.written, target.path);
  if (!is_strip) around.exporter.saved = around.state.edition;
  return {{"path", target.path.string()}};
}

Outcome open_scene(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const ShownMolecule& molecule = around.molecule;
  const Exporter& exporter = around.exporter;
  if (!exporter.context.open_scene) throw RequestError("open: this preview reads no scenes");
  const std::string name = command.text("path");
  const std::filesystem::path path = export_path(exporter.folder, name);
  const std::optional<StoryboardFile> story = read_storyboard(path.string());
  const auto opened_scene = [&](std::size_t n) {
    return exporter.context.open_scene(story ? fmt::format("{}#{}", path.string(), n + 1) : path.string());
  };
  const auto take = [&](OpenedScene opened) {
    const ColorScheme& first = around.first.molecule.color;
    ColorScheme& color = opened.figure.molecule.color;
    if (color.by == ColorScheme::By::rmsf && color.by == first.by) color.file = first.file;
    require_previewed(color);
    static_cast<PreviewFigure&>(state) = std::move(opened.figure);
    require_copies_apart(molecule.structure(), state, around.state.probe_reach());
    if (molecule.has_models()) state.frame = static_cast<std::size_t>(opened.frame);
    if (state.frame >= molecule.frame_count()) throw RequestError("open: {} is of a model that is not there", name);
  };
  if (story) state.strip.clear();
  for (std::size_t n = story ? story->scenes.size() : 1; n-- > 0;) {
    take(opened_scene(n));
    if (!story) continue;
    KeptScene kept{state, state.frame};
    kept.number = ++state.last_kept;
    if (!story->hold.empty()) kept.hold = story->hold[std::min(n, story->hold.size() - 1)];
    if (!story->transition.empty()) kept.transition = story->transition[std::min(n, story->transition.size() - 1)];
    state.strip.insert(state.strip.begin(), std::move(kept));
  }
  state.strip_place = 0.0;
  const Renewal renewal = state.frame == around.state.frame ? Renewal::shapes : Renewal::frame;
  Outcome next{std::move(state), renewal, {{"path", (exporter.folder / name).string()}}, true};
  next.is_saved = true;
  return next;
}

}  // namespace meniscus
