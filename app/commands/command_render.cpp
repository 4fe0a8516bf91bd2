// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render`: ray casts a molecule into a picture, or the frames of a run into pictures or a film.

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/picture_sink.h"
#include "app/film/film.h"
#include "app/options/named_files.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/image/cryptomatte.h"
#include "core/render/image_output.h"
#include "core/render/picture_file.h"
#include "core/scene/frame_run.h"
#include "core/scene/renderers.h"
#include "core/scene/representations.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_picture.h"
#include "core/scene/scene_values.h"
#include "core/scene/transition.h"
#include "core/structure/structure.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

std::string named(const std::string& text) { return text.empty() ? "-" : escaped(text); }

std::string residue_of(const Atom& atom) {
  if (atom.residue_name.empty()) return "-";
  const std::string code = atom.insertion_code == ' ' ? "" : escaped(std::string(1, atom.insertion_code));
  return fmt::format("{} {}{}", escaped(atom.residue_name), atom.residue_number, code);
}

/// Collects a matte name by name.
class Namer {
 public:
  explicit Namer(const char* layer) : matte_{layer, {}, {}} {}

  void add(const std::string& name) {
    const auto [known, is_new] = ids_.try_emplace(name, 0);
    if (is_new) known->second = matte_id(name);
    matte_.id.push_back(known->second);
  }

  Matte take() {
    nlohmann::json manifest = nlohmann::json::object();
    for (const auto& [name, id] : ids_) manifest[name] = fmt::format("{:08x}", id);
    matte_.manifest = manifest.dump();
    return std::move(matte_);
  }

 private:
  Matte matte_;
  std::unordered_map<std::string, std::uint32_t> ids_;
};

/// Returns CryptoChain, CryptoResidue and CryptoAtom of shown_atoms(): "A", "A/LYS 15", "A/LYS 15/CA", with "-" for a
/// name that the file does not give. The place in the file distinguishes atoms of one name: the second has "#42"
/// appended. Copies of one atom (Instances) share a name.
std::shared_ptr<const std::vector<Matte>> mattes_of(const Structure& structure) {
  Namer chains("CryptoChain"), residues("CryptoResidue"), atoms("CryptoAtom");
  std::unordered_map<std::string, std::uint32_t> places;  // places in the file, by name
  for (const Atom& atom : shown_atoms(structure)) {
    const std::string chain = named(atom.chain), residue = chain + "/" + residue_of(atom);
    std::string name = residue + "/" + named(atom.name);
    const std::uint32_t first = places.try_emplace(name, atom.index).first->second;
    if (first != atom.index) name += fmt::format("#{}", atom.index);
    chains.add(chain);
    residues.add(residue);
    atoms.add(name);
  }
  auto mattes = std::make_shared<std::vector<Matte>>();
  for (Namer* const namer : {&chains, &residues, &atoms}) mattes->push_back(namer->take());
  return mattes;
}

/// Returns the bytes that a pixel of an .exr takes before compression.
double channel_bytes(const Scene& scene) {
  return 16.0 + (scene.image.aovs ? 72.0 : 0.0) + (scene.image.cryptomatte ? 144.0 : 0.0);
}

void log_memory(const RenderCommand& command) {
  constexpr double kManyPixels = 3e7, kMebibyte = 1 << 20;
  const Scene& scene = command.scene;
  const double pixels = static_cast<double>(scene.picture.width) * scene.picture.height;
  if (pixels < kManyPixels || !is_encoded_in_memory(scene.output)) return;
  log_line(command, fmt::format("note: writing {} files takes up to {} MiB of additional memory; .png takes none",
                                std::filesystem::path(scene.output).extension().string(),
                                with_thousands(static_cast<std::uint64_t>(pixels * channel_bytes(scene) / kMebibyte))));
}

void warn_of_hue_changes(const RenderCommand& command) {
  const std::string changes = hue_changes(command.scene.look);
  if (changes.empty() || hues_of(command.scene.molecule.color, false) != Hues::kept) return;
  log_line(command, "warning: the colours of the surface differ from the legend: " + changes);
}

/// Sets the default output: the molecule's name, in the current folder.
void name_output(const CLI::App& program, RenderCommand& command) {
  Scene& scene = command.scene;
  if (!scene.output.empty()) return;
  if (scene.frames.is_requested())
    throw UsageError(
        "-o is missing: name the pictures of the frames, such as frame_#####.png, or a film, such as a.mp4");
  std::filesystem::path name = std::filesystem::path(scene.molecule.file).filename();
  if (name.extension() == ".gz") name = name.stem();
  name = name.stem();
  if (name.empty() || name == "-") throw UsageError("-o is missing: name the picture, such as -o picture.png");
  scene.output = name.string() + ".png";
  NamedFiles files(program);
  files.write("--output", scene.output);
  if (!scene.legend.file.empty()) files.write("--legend-file", scene.legend.file);
  files.check();
  log_line(command, "the picture goes to " + scene.output + "; -o PATH sends it elsewhere");
}

/// Refuses layers and colour spaces that the format of the output cannot hold.
void check_layers(const Scene& scene) {
  const PictureOutput& image = scene.image;
  const char* const layers = image.aovs ? "--aovs" : image.cryptomatte ? "--cryptomatte" : "";
  if (image.motion_blur > 1 && (*layers || image.extent))
    throw UsageError("--motion-blur and {} cannot be combined; leave one of them out", *layers ? layers : "--extent");
  if (*layers && !holds_aovs(scene.output))
    throw UsageError("{} needs an .exr output; other formats hold colour only", layers);
  if (*layers && image.extent) throw UsageError("{} needs the complete surface; leave --extent out", layers);
  if (image.primaries != Primaries::rec709 && !holds_aovs(scene.output))
    throw UsageError("--color-space acescg needs an .exr output; other formats and films are sRGB");
}

/// Checks the scene before anything is read.
void check_scene(const RenderCommand& command) {
  const Scene& scene = command.scene;
  if (scene.frames.is_requested()) {
    if (is_film_path(scene.output) && !scene.frames.only.empty())
      throw UsageError("--only: a film needs all frames; write the chunk as pictures: frame_#####.png");
    numbered_output(scene.output, scene.film, scene.picture.size());
  } else {
    if (const std::string_view format = bare_trajectory_format(scene.molecule.file); !format.empty())
      throw UsageError(
          "{} is a trajectory ({}), which has no atoms of its own: name its topology before it, "
          "as in meniscus render topology.pdb {}",
          in_quotes(scene.molecule.file), format, in_quotes(scene.molecule.file));
    if (is_film_path(scene.output))
      throw UsageError(
          "-o {} is a film, and {} one molecule; add --frames all for the models of that file, "
          "--trajectory FILE, or --turntable 1",
          in_quotes(scene.output), in_quotes(scene.molecule.file));
    check_image_path(scene.output);
  }
  check_cost(command, scene, scene.picture.size());
  if (scene.image.motion_blur > 1 && !scene.frames.is_requested())
    throw UsageError("--motion-blur: one molecule does not move; add the frames of a run (--frames)");
  check_layers(scene);
  if (scene.image.extent && (!scene.figure.plain() || !scene.molecule.color.opacities.empty()))
    throw UsageError(
        "--extent draws only the surface, whole and opaque; leave out --extent, or --opacity, --clip, --sticks and "
        "similar options");
  if (scene.image.extent &&
      (scene.look.shadows.value_or(0.0f) > 0.0f || scene.look.ambient_occlusion_rays.value_or(0.0f) > 0.0f))
    throw UsageError("--shadows and --ambient-occlusion-rays need the complete surface; leave --extent out");
  if (!scene.image.extent && command.stats) throw UsageError("--stats reports the stages of a view; add --extent");
  check_picture(scene);
}

/// Opens the outputs before the work begins, so that errors come early, and removes them again.
void check_files(const RenderCommand& command) {
  const Scene& scene = command.scene;
  if ((!scene.frames.is_requested() || is_film_path(scene.output)) && !command.resumes)
    check_output(scene.output, command.existing());
  if (!scene.legend.file.empty()) {
    check_image_path(scene.legend.file);
    check_output(scene.legend.file, command.existing());
  }
  check_saved_camera(command);
}

/// Draws the figures. On the CPU several pictures are made at once; with GL the surfaces may be computed on the CPU at
/// once, and pictures are drawn one after another.
void draw_figures(FigureRun& run, const PictureLayout& layout, PictureSink& sink, PictureDevice& device) {
  std::optional<MotionBlur> blur;
  if (const int moments = run.scene().image.motion_blur; moments > 1)
    blur.emplace(run.scene(), moments, run.framing().cameras, device.context());
  const auto keep = [&](StillRenderer& renderer, FigureFrame frame) {
    SinkPicture picture{frame.number, frame.place, frame.source, frame.time, frame.camera};
    if (run.scene().image.cryptomatte) picture.mattes = mattes_of(frame.figure.molecule.structure);
    picture.moves = !frame.velocities.empty();
    const FigureMotion motion{std::move(frame.velocities), run.next_camera(frame.place)};
    Annotations annotations = sink.annotations(picture, frame.figure.molecule.structure, frame.figure.extras.lengths());
    std::vector<std::string> unseen;
    const bool is_logged = !run.is_run() && !run.command().reporting.quiet;
    const Survey survey = survey_of(run.scene(), frame.figure.molecule.structure, frame.camera, layout.size.size(),
                                    annotations, is_logged ? &unseen : nullptr);
    const FinishFrame finish = sink.keep(picture, annotations, [&](const RenderSettings& settings) {
      if (blur) {
        Framebuffer drawn = blur->draw(frame.place, renderer, settings);
        if (settings.take_band) settings.take_band(Framebuffer(drawn), 0);
        return drawn;
      }
      return draw(renderer, std::move(frame.figure), run.scene().figure, frame.camera, settings, survey, &motion);
    });
    for (const std::string& sentence : unseen) log_line(run.command(), "note: " + sentence);
    return finish;
  };
  // The estimate counts sums, samples and buffers of the look, and files.
  const PictureOutput& image = run.scene().image;
  const std::uint64_t bytes_per_pixel = 84 + static_cast<std::uint64_t>(channel_bytes(run.scene())) +
                                        (image.cryptomatte ? 4 * static_cast<std::uint64_t>(image.samples) : 0);
  const glm::u64vec2 size(run.scene().picture.size());
  const FigureWork work{kSurfaceBytesPerAtom, bytes_per_pixel * size.x * size.y, device.context()};
  run.make(work, [&]() -> FigureRun::Sink {
    if (!device.context() && run.is_run()) {
      const auto renderer = std::make_shared<StillRenderer>();
      return [&keep, renderer](FigureFrame frame) { return keep(*renderer, std::move(frame)); };
    }
    return [&](FigureFrame frame) -> FinishFrame {
      auto waiting = std::make_shared<FigureFrame>(std::move(frame));
      return [&keep, &device, waiting] { return keep(device.renderer(), std::move(*waiting))(); };
    };
  });
}

void render_figures(RenderCommand command) {
  FigureRun run(command, command.scene.image.aovs ? Velocities::forward : Velocities::none);
  command.scene.picture.height = run.fit();
  const PictureLayout layout(command.scene, run.key());
  run.aim(layout.size, false);
  PictureSink sink(command, layout, run.is_run() ? &run.frames() : nullptr);
  if (run.is_run()) sink.check(run.framing().cameras, run.structure());
  PictureDevice device(picture_request(command.scene));
  draw_figures(run, layout, sink, device);
  sink.finish();
  if (layout.legend_apart)
    write_legend_picture(command.scene.legend.file, *layout.legend_apart, image_settings(command));
  run.save_cameras();
  if (!run.is_run()) log_times(command, device.renderer().device(), device.renderer().times());
}

/// Returns true if surfaces are divided, or their pieces named or measured.
bool needs_borders(const Scene& scene) {
  const MoleculeRequest& molecule = scene.molecule;
  return scene.image.aovs || molecule.patches || molecule.color.of_points() ||
         molecule.color.by == ColorScheme::By::component || molecule.division.components ||
         molecule.division.cavities != Cavities::keep;
}

/// Keeps only the missing pictures, in a run their frames; returns false if none is missing.
bool leave_missing(RenderCommand& command) {
  const bool is_run = command.scene.frames.is_requested();
  const std::optional<NumberedPath> pictures = NumberedPath::parse(command.scene.output);
  if (is_run && !pictures)
    throw UsageError("--resume: a film is made as a whole; name pictures instead, such as -o frame_#####.png");
  command.made_of = made_of(command.scene);
  std::vector<std::string> paths{command.scene.output};
  std::vector<std::uint64_t> frames;
  if (is_run) {
    Scene scene = prepared_scene(command.scene);
    freeze_selections(scene);
    frames = FrameRun(scene.molecule, scene.frames).chunk();
    paths.clear();
    for (const std::uint64_t frame : frames) paths.push_back(pictures->at(frame));
  }
  const std::vector<std::size_t> missing = missing_pictures(paths, command.made_of, command.existing());
  log_line(command, fmt::format("{} of {} pictures are there", with_thousands(paths.size() - missing.size()),
                                with_thousands(paths.size())));
  std::vector<std::uint64_t> numbers;
  for (const std::size_t n : missing)
    if (is_run) numbers.push_back(frames[n]);
  if (is_run) command.scene.frames.only = frame_list_text(numbers);
  return !missing.empty();
}

/// Takes a copy of the command, because the scene is saved as the user set it.
void run(RenderCommand command) {
  if (command.is_draft) make_draft(command.scene);
  command.keeps_scene = command.names_program && !command.scene.frames.is_requested();
  warn_of_hue_changes(command);
  if (const std::string fault = scene_fault(command.scene); command.keeps_scene && !fault.empty()) {
    command.keeps_scene = false;
    log_line(command, "note: the picture carries no scene: " + fault);
  }
  check_scene(command);
  check_files(command);
  log_memory(command);
  if (command.resumes && !leave_missing(command)) return;
  command.scene.molecule.surface.bordered = needs_borders(command.scene);
  command.scene.image.extent ? render_views(command) : render_figures(command);
}

}  // namespace

void add_render(CLI::App& command) {
  describe(
      command,
      "  meniscus render 1tii.pdb -o 1tii.png\n"
      "  meniscus render 1tii.pdb -o 1tii.png --size 3840x2160 --samples 16 --color chain --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.png --color hydrophobicity --legend --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.png --color chain --preset flat --background white\n"
      "  meniscus render 1tii.pdb -o 1tii.exr --aovs --camera camera.json   depth, normals, atoms for compositing\n"
      "  meniscus render adk.psf --trajectory adk.dcd --frames all --superpose 'name CA' -o adk.mp4");
  auto declared = std::make_shared<DeclaredCommand<RenderCommand>>(command, render_properties());
  RenderCommand& state = declared->state;
  declared->options.describe_output(
      "Picture to write: .png, .jpg, .webp, .tif, .exr, .svg, .pdf [FILE's name here, as .png]; for frames: "
      "frame_#####.png, or a "
      "film: .mp4, .mov, .mkv, .webm, .gif",
      OutputName::optional);
  PropertyOptions options(command);
  options.add("picture.stats", state.stats);
  options.add("picture.draft", state.is_draft);
  options.add("picture.resume", state.resumes);
  CLI::Option* const provenance = options.add("picture.provenance", state.provenance);
  options.add_switch("picture.no_provenance", [&state] { state.names_program = false; })->excludes(provenance);
  command.callback([declared, &command] {
    declared->options.take();
    name_output(command, declared->state);
    run_and_save_scene(declared->state, [&] { run(declared->state); });
  });
}

}  // namespace meniscus
