// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render`: a picture of the surface by ray casting its analytic patches.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/commands.h"
#include "app/commands/figure_export.h"
#include "app/options/figure_options.h"
#include "app/options/look_options.h"
#include "app/options/property_options.h"
#include "app/options/scene_file.h"
#include "app/process/command_line.h"
#include "app/process/program_error.h"
#include "core/scene/molecule.h"
#include "app/commands/render_command.h"
#include "app/commands/view_picture.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/gpu/egl_context.h"
#include "core/render/image_output.h"
#include "core/render/picture_file.h"
#include "core/render/renderer.h"
#include "core/scene/picture_device.h"
#include "core/scene/view_aim.h"
#include "app/reports/notes.h"
#include "app/options/camera_file.h"

namespace meniscus {
namespace {

void parse_extent(const std::string& text, std::optional<Extent>& extent) {
  const std::map<std::string, Extent> words{
      {"complete", Extent::complete}, {"visible", Extent::visible}, {"paper", Extent::paper}};
  const auto word = words.find(text);
  if (word == words.end())
    throw CLI::ValidationError("--extent", in_quotes(text) + " is none of visible, complete, paper");
  extent = word->second;
}

// Before the work begins.
void check_legend_file(const RenderCommand& command) {
  if (command.legend.file.empty()) return;
  check_image_path(command.legend.file);
  check_output(command.legend.file, command.output.existing());
}

void finish(const RenderCommand& command, const PictureLayout& layout, PictureFile& picture, const Camera& camera) {
  if (!picture.shows_something())
    say(command.molecule,
        "warning: the picture shows nothing: no ray meets a part of the surface that --show and --clip leave; where "
        "does the "
        "camera look?");
  picture.commit();
  if (layout.legend_alone) write_image(command.legend.file, *layout.legend_alone, image_settings(command));
  save_camera(command.save_camera, command.output.existing(), camera);
}

void say_times(const RenderCommand& command, const std::string& device, const std::vector<StageTime>& stages) {
  std::string times;
  for (const StageTime& stage : stages)
    times += fmt::format("{}{} {:.1f} ms", times.empty() ? "" : ", ", stage.name, stage.milliseconds);
  say(command.molecule, fmt::format("picture on {}: {}", device, times));
}

// For a picture whose times are said.
RenderSettings timed_settings(const RenderCommand& command, const PictureLayout& layout) {
  RenderSettings settings = render_settings(command, layout);
  if (command.stats || !command.molecule.quiet) settings.timing = StageTiming::exact;
  return settings;
}

/// Tells how far a picture is that takes long on the CPU; GL makes it in a fraction of the time.
class PictureProgress {
 public:
  PictureProgress(const RenderCommand& command, RenderSettings& settings) {
    const double rays = static_cast<double>(settings.samples) * settings.size.x * settings.size.y;
    if (command.molecule.quiet || rays < kManyRays) return;
    progress_.emplace(progress_on_stderr(command.molecule), "picture", kParts);
    settings.progress = [this](double share) { tell(static_cast<std::uint64_t>(share * kParts)); };
  }
  void end() {
    if (progress_) tell(kParts);
  }

 private:
  void tell(std::uint64_t parts) {
    if (parts <= told_) return;
    progress_->advance(parts - told_);
    told_ = parts;
  }

  static constexpr double kManyRays = 5e7;  // some seconds
  static constexpr std::uint64_t kParts = 100;
  std::optional<Progress> progress_;
  std::uint64_t told_ = 0;
};

void tell_memory(const RenderCommand& command) {
  constexpr double kManyPixels = 3e7, kMebibyte = 1 << 20;
  const double pixels = static_cast<double>(command.picture.width) * command.picture.height;
  if (pixels < kManyPixels || !is_encoded_in_memory(command.output.path)) return;
  say(command.molecule,
      fmt::format("note: {} files are encoded in memory: up to {} MiB beside the picture's bands; .png, .jpg and .tif "
                  "are written as they come",
                  std::filesystem::path(command.output.path).extension().string(),
                  with_thousands(static_cast<std::uint64_t>(pixels * (command.aovs ? 56.0 : 16.0) / kMebibyte))));
}

// Without the complete surface: from atoms to the picture on the GPU.
void draw_view(const RenderCommand& command) {
  const std::optional<Camera> given = given_camera(command.picture);
  const ColoredAtoms atoms = load_atoms(command.molecule);
  const PictureLayout layout(command, key_of(atoms.molecule));
  const Annotations annotations = annotations_of(command.annotations, atoms.molecule.structure);
  const ViewAim aim(command.picture, command.molecule.show, atoms.molecule.structure);
  const Camera camera = aim.camera(layout.size, given, atoms.balls);
  const EglContext context(gl_device(command));
  ViewPipeline view;
  show(atoms, command.molecule.surface.probe_radius, *command.extent, view);
  Renderer renderer;
  RenderSettings settings = timed_settings(command, layout);
  PictureFile picture(command.output.path, {annotations, layout.legend}, camera, image_settings(command), settings);
  renderer.render(view, camera, settings);
  if (command.stats) fmt::print(std::cerr, "{}", stats_text(view.stats(), renderer.times(), settings.size));
  say_times(command, gl_words(context), renderer.times());
  finish(command, layout, picture, camera);
}

void tell_hue_changes(const RenderCommand& command) {
  const std::string changes = hue_changes(command.look);
  if (changes.empty() || hues_of(command.molecule.color, command.legend.asked()) == Hues::free) return;
  say(command.molecule, "warning: colours of the surface are not those of the legend: " + changes);
}

/// Without -o the picture has the molecule's name, in the current folder.
void name_output(RenderCommand& command) {
  if (!command.output.path.empty()) return;
  if (command.frames.asked())
    throw UsageError(
        "-o is missing: name the pictures of the frames, such as frame_#####.png, or a film, such as a.mp4");
  std::filesystem::path name = std::filesystem::path(command.molecule.file).filename();
  if (name.extension() == ".gz") name = name.stem();
  name = name.stem();
  if (name.empty() || name == "-") throw UsageError("-o is missing: what shall the picture be called?");
  command.output.path = name.string() + ".png";
  say(command.molecule, "the picture goes to " + command.output.path + "; -o PATH sends it elsewhere");
}

void run(const RenderCommand& command) {
  tell_hue_changes(command);
  if (command.frames.asked()) return render_frames(command);
  check_image_path(command.output.path);
  if (command.aovs && !holds_aovs(command.output.path))
    throw UsageError("--aovs needs an .exr output; other formats hold colour only");
  if (command.extent) {
    check_view_options(command.molecule);
    if (command.aovs) throw UsageError("--aovs needs the complete surface; leave --extent away");
    if (!command.figure.plain() || !command.molecule.color.opacities.empty())
      throw UsageError(
          "--extent draws the surface alone, whole and opaque; leave --extent away, or --opacity, --clip and the like");
  } else if (command.stats) {
    throw UsageError("--stats tells the stages of a view; add --extent");
  }
  if (command.legend.asked() && command.molecule.color.by == ColorScheme::By::fixed &&
      command.molecule.color.rules.empty())
    throw UsageError("--legend has nothing to explain where all is of one colour; choose another --color");
  // Whether the outputs can be written is known before the work begins; these vanish again.
  check_output(command.output.path, command.output.existing());
  check_legend_file(command);
  check_camera_file(command.save_camera, command.output.existing());
  tell_memory(command);
  if (command.extent) return draw_view(command);
  AimedFigure aimed = aimed_figure(command);
  const PictureLayout layout(command, key_of(aimed.figure.molecule));
  const Annotations annotations = annotations_of(command.annotations, aimed.figure.molecule.structure);
  const Camera camera = aimed.camera(command, layout.size);
  PictureDevice device(picture_request(command));
  SurfaceRenderer& renderer = device.renderer();
  RenderSettings settings = timed_settings(command, layout);
  PictureProgress progress(command, settings);
  PictureFile picture(command.output.path, {annotations, layout.legend}, camera, image_settings(command), settings);
  draw(renderer, std::move(aimed.figure), command.figure, camera, settings);
  progress.end();
  finish(command, layout, picture, camera);
  say_times(command, renderer.device(), renderer.times());
}

}  // namespace

PictureLayout::PictureLayout(const RenderCommand& command, const ColorKey& key) : size(command.picture) {
  const glm::ivec2 whole(size.width, size.height);
  if (!command.legend.file.empty()) legend_alone = Legend(key, whole, command.legend.style).alone(command.background);
  if (!command.legend.within) return;
  legend.emplace(key, whole, command.legend.style);
  size.width = legend->molecule_size().x;
  size.height = legend->molecule_size().y;
}

ImageSettings image_settings(const RenderCommand& command) {
  ImageSettings settings{command.background, command.output.existing(), command.look.has_linear_alpha()};
  settings.dots_per_inch = command.picture.dots_per_inch;
  settings.names_program = command.names_program;
  if (command.provenance) settings.command = command_line();
  if (command.names_program && !command.frames.asked()) settings.scene = command.scene;
  return settings;
}

SurfaceRequest picture_request(const RenderCommand& command) {
  SurfaceRequest request = command.molecule.surface;
  // Volume maps are looked up point by point on the CPU.
  request.cpu = request.cpu || command.molecule.color.by == ColorScheme::By::volume;
  return request;
}

RenderSettings render_settings(const RenderCommand& command, const PictureLayout& layout) {
  RenderSettings settings;
  settings.size = {layout.size.width, layout.size.height};
  settings.samples = command.samples;
  settings.aovs = command.aovs;
  settings.look = look_of(command.look, {command.picture.width, command.picture.height}, command.background,
                          hues_of(command.molecule.color, command.legend.asked()));
  return settings;
}

DeviceChoice gl_device(const RenderCommand& command) { return command.molecule.surface.gl; }

void add_render(CLI::App& command) {
  describe(
      command, "Ray cast a picture of the analytic surface",
      "  meniscus render 1tii.pdb -o 1tii.png\n"
      "  meniscus render 1tii.pdb -o 1tii.png --size 3840x2160 --samples 16 --color chain --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.png --color hydrophobicity --legend --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.png --color chain --preset flat --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.exr --aovs --camera camera.json   depth, normals, atoms for compositing\n"
      "  meniscus render adk.psf --trajectory adk.dcd --frames all --superpose 'name CA' -o adk.mp4");
  auto state = std::make_shared<RenderCommand>();
  add_shown_options(command, *state);
  add_run_options(command, *state);
  add_look_options(command, state->look, state->picture);
  add_scene_options(command, &state->save_scene);
  add_output_options(
      command, state->output,
      "Picture to write: .png, .jpg, .webp, .tif, .exr [FILE's name here, as .png]; of frames: frame_#####.png, or a "
      "film: .mp4, .mov, .mkv, .webm, .gif",
      OutputName::optional);
  PropertyOptions options(command);
  options.add("image.samples", state->samples);
  add_background_option(command, state->background);
  add_legend_options(command, state->legend, state->picture);
  add_annotation_options(command, state->annotations);
  add_curve_options(command, state->annotations);
  options.add("image.aovs", state->aovs);
  options.add_parsed("image.extent", [state](const std::string& text) { parse_extent(text, state->extent); });
  options.add("picture.stats", state->stats);
  CLI::Option* const provenance = options.add("picture.provenance", state->provenance);
  options.add_switch("picture.no_provenance", [state] { state->names_program = false; })->excludes(provenance);
  add_save_camera_option(command, state->save_camera);
  options.add("frames.fps", state->frames_per_second);
  add_film_options(command, state->film);
  command.callback([state, &command] {
    state->figure.ask_for(state->molecule.reading);
    take_interface(command, state->molecule, state->picture);
    name_output(*state);
    state->scene = scene_text(command, "");
    SceneOutput scene(command, state->save_scene, state->output.existing());
    run(*state);
    scene.commit();
  });
}

}  // namespace meniscus
