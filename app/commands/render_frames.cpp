// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render --frames`: numbered pictures, or a film.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/film/film.h"
#include "app/reports/run_frames.h"
#include "core/scene/molecule.h"
#include "app/options/camera_file.h"
#include "app/options/numbered_path.h"
#include "app/process/program_error.h"
#include "app/commands/figure_export.h"
#include "app/commands/render_command.h"
#include "app/commands/view_picture.h"
#include "core/base/text.h"
#include "app/reports/notes.h"
#include "core/gpu/egl_context.h"
#include "core/render/image_output.h"
#include "core/render/renderer.h"
#include "core/scene/picture_device.h"
#include "core/scene/run_framing.h"
#include "core/scene/settled_selections.h"

namespace meniscus {
namespace {

/// Did no ray of the picture meet a part of the surface that is shown?
bool shows_nothing(const Framebuffer& picture) {
  return std::ranges::none_of(picture.color, [](const glm::vec4& pixel) { return pixel.w > 0.0f; });
}

void check_options(const RenderCommand& command) {
  if (command.stats) throw UsageError("--stats: of one picture only; leave --frames away");
  if (command.aovs && !holds_aovs(command.output.path))
    throw UsageError("--aovs needs .exr outputs; other formats hold colour only");
  if (!command.save_camera.empty() && command.run_camera.moves()) throw UsageError(kNoSingleCamera);
  if (command.extent) check_view_options(command.molecule);
  if (command.molecule.interface) throw UsageError("--interface: of one picture only; leave --frames away");
  if (!command.annotations.labels.empty())
    throw UsageError("--label: of one picture only, for the atoms move; leave --frames away");
  if (!command.legend.file.empty()) check_image_path(command.legend.file);
}

/// Pictures with numbers in their names, or a film.
class PictureSink {
 public:
  explicit PictureSink(const RenderCommand& command) : command_(command) {
    const std::string& path = command.output.path;
    const glm::ivec2 size{command.picture.width, command.picture.height};
    if (is_film_path(path)) {
      if (!command.frames.only.empty())
        throw UsageError("--only: a film needs all frames; write the chunk as pictures: frame_#####.png");
      film_ =
          std::make_unique<FilmWriter>(path, command.output.existing(), size, command.frames_per_second, command.film);
      return;
    }
    numbered_ = NumberedPath::parse(path);
    if (!numbered_) {
      const std::filesystem::path plain(path);
      const std::filesystem::path name =
          plain.parent_path() /
          (plain.stem().string() + "_#####" + (plain.has_extension() ? plain.extension().string() : ".png"));
      throw UsageError(
          fmt::format("-o {}: every frame would replace the one before; put # where its number shall "
                      "stand, as in {}, or name a film (.mp4)",
                      in_quotes(path), in_quotes(name.string())));
    }
    check_image_path(path);
  }

  /// On any thread: writes the picture, or leaves to its turn that it is added to the film.
  FinishFrame keep(std::uint64_t number, const Framebuffer& picture, bool shows_nothing) {
    if (film_) {
      auto pixels =
          std::make_shared<const std::vector<std::uint8_t>>(srgb_pixels(picture, ground(), film_->pixels().bytes));
      return [this, pixels, shows_nothing] {
        film_->add(*pixels);
        return MadeFrame{{}, shows_nothing};
      };
    }
    const std::string path = numbered_->at(number);
    write_image(path, picture, image_settings(command_));
    return [path, shows_nothing] { return MadeFrame{{path}, shows_nothing}; };
  }

  void finish() {
    if (film_) film_->finish();
  }

 private:
  /// White where none was asked for, but in a film that keeps what is transparent.
  std::optional<glm::vec3> ground() const {
    if (command_.background || film_->pixels().channels == 4) return command_.background;
    return glm::vec3(1.0f);
  }

  const RenderCommand& command_;
  std::optional<NumberedPath> numbered_;
  std::unique_ptr<FilmWriter> film_;
};

/// Which frame a picture shows.
struct FrameShown {
  std::uint64_t number, source, place;
  std::optional<double> time;

  explicit FrameShown(const RunFrame& frame)
      : number(frame.number), source(frame.source), place(frame.place), time(frame.time) {}
};

/// Takes a picture of a frame to where it belongs, on any thread.
using KeepPicture = std::function<FinishFrame(const FrameShown& frame, Framebuffer picture)>;

/// What the pictures of a run have in common.
struct RunPictures {
  const RenderCommand& command;
  const std::vector<Camera>& cameras;  ///< of the places in the run
  const RenderSettings& settings;
  KeepPicture keep;
};

/// Pictures of complete surfaces. On the CPU all of a frame is made while others are; by GL the surfaces, if they come
/// from the CPU, and one picture after another.
class CompletePainter {
 public:
  CompletePainter(const RunPictures& run, const FrameRun& frames)
      : run_(run),
        device_(picture_request(run.command)),
        builders_(frame_builders(frames, run.command.molecule, run.command.frames, bytes_of_frame(run, frames),
                                 device_.context())) {}

  std::span<const std::shared_ptr<MoleculeBuilder>> builders() const { return builders_; }

  std::vector<FrameWorker> workers() {
    std::vector<FrameWorker> workers;
    for (const auto& builder : builders_) workers.push_back(device_.context() ? by_gl(builder) : on_cpu(builder));
    return workers;
  }

 private:
  static std::uint64_t bytes_of_frame(const RunPictures& run, const FrameRun& frames) {
    constexpr std::uint64_t kBytesPerPixel = 100;  // sums, samples and what a look needs of them, files
    const glm::u64vec2 size(run.settings.size);
    return kSurfaceBytesPerAtom * frames.structure().atoms.size() + kBytesPerPixel * size.x * size.y;
  }

  FrameWorker on_cpu(const std::shared_ptr<MoleculeBuilder>& builder) const {
    std::shared_ptr<SurfaceRenderer> renderer = make_cpu_renderer();
    return [this, builder, renderer](RunFrame frame) {
      const FrameShown shown(frame);
      Figure figure = make_figure(builder->build(std::move(frame.structure)), run_.command.figure);
      return run_.keep(
          shown, draw(*renderer, std::move(figure), run_.command.figure, run_.cameras[shown.place], run_.settings));
    };
  }

  FrameWorker by_gl(const std::shared_ptr<MoleculeBuilder>& builder) {
    return [this, builder](RunFrame frame) -> FinishFrame {
      const FrameShown shown(frame);
      auto figure =
          std::make_shared<Figure>(make_figure(builder->build(std::move(frame.structure)), run_.command.figure));
      return [this, figure, shown] {
        return run_.keep(shown, draw(device_.renderer(), std::move(*figure), run_.command.figure,
                                     run_.cameras[shown.place], run_.settings))();
      };
    };
  }

  const RunPictures& run_;
  PictureDevice device_;
  std::vector<std::shared_ptr<MoleculeBuilder>> builders_;
};

/// Pictures of what the view needs (--extent), one after another.
class ViewPainter {
 public:
  ViewPainter(const RunPictures& run, const Structure& structure)
      : run_(run), context_(gl_device(run.command)), atoms_(colored_atoms(run.command.molecule, structure)) {}

  FrameWorker worker() {
    return [this](const RunFrame& frame) -> FinishFrame {
      atoms_.balls = balls_of(frame.structure);
      show(atoms_, run_.command.molecule.surface.probe_radius, *run_.command.extent, pipeline_);
      return run_.keep(FrameShown(frame), renderer_.render(pipeline_, run_.cameras[frame.place], run_.settings));
    };
  }

 private:
  const RunPictures& run_;
  EglContext context_;
  ColoredAtoms atoms_;
  ViewPipeline pipeline_;
  Renderer renderer_;
};

/// The curve of --curve over the frames of the run, the same in all pictures but for the mark.
std::optional<Curve> run_curve(const RenderCommand& command, const FrameRun& frames) {
  std::vector<std::uint64_t> numbers = frames.numbers();
  for (std::uint64_t& number : numbers) number = frames.source(number);
  return curve_of(command.annotations, numbers);
}

}  // namespace

void render_frames(const RenderCommand& asked) {
  check_options(asked);
  RenderCommand command = asked;
  with_settled_selections(command);
  const GivenCameras given = given_cameras(command.picture, command.run_camera);
  FrameRun frames(command.molecule, command.frames);
  tell_run(command.molecule, frames);
  measure_colors(command.molecule.color, frames);
  Molecule first;  // what the colours mean does not change with the frames
  first.structure = frames.reach();
  first.color = color_of(command.molecule);
  if (command.extent && first.color.changes_with_frames())
    throw UsageError("colours that change from frame to frame need the complete surface; leave --extent away");
  if (command.extent && selects_by_positions(command.molecule))
    throw UsageError(
        "--extent: what a selection by distance means changes from frame to frame; add --select-once, or leave "
        "--extent "
        "away");
  const PictureLayout layout(command, key_of(first));
  PictureSink sink(command);
  const std::vector<Camera> cameras =
      run_cameras(layout.size, command.molecule.show, command.run_camera, given, frames);
  save_camera(command.save_camera, command.output.existing(), cameras.front());
  tell_idle_cuts(command, frames, cameras.front());
  const RenderSettings settings = render_settings(command, layout);
  if (layout.legend_alone) write_image(command.legend.file, *layout.legend_alone, image_settings(command));
  const Annotations annotations = annotations_of(command.annotations, frames.structure());
  const std::optional<Curve> curve = run_curve(command, frames);
  std::mutex legend;  // its letters come from one font, which is one thread's at a time
  const auto keep = [&](const FrameShown& frame, Framebuffer picture) {
    const bool empty = shows_nothing(picture);
    Annotations written = annotations;
    if (command.annotations.time_stamp) written.time = time_text(frame.time, frame.source);
    written.curve = curve;
    if (curve) written.curve->now = frame.place;
    annotate(picture, written, cameras[frame.place], command.background);
    if (layout.legend) {
      const std::lock_guard lock(legend);
      picture = layout.legend->add_to(picture, command.background);
    }
    return sink.keep(frame.number, picture, empty);
  };
  const RunPictures run{command, cameras, settings, keep};
  if (command.extent) {
    ViewPainter painter(run, frames.structure());
    run_frames(frames, command.molecule, command.frames, {painter.worker()});
  } else {
    CompletePainter painter(run, frames);
    run_frames(frames, command.molecule, command.frames, painter.workers());
    tell_beyond_map(command.molecule, painter.builders());
  }
  sink.finish();
}

}  // namespace meniscus
