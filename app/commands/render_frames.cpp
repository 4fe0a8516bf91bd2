// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render --frames`: numbered pictures, or a film.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/film/film.h"
#include "app/reports/run_frames.h"
#include "core/scene/molecule.h"
#include "app/options/numbered_path.h"
#include "app/process/program_error.h"
#include "app/commands/render_command.h"
#include "app/commands/view_picture.h"
#include "core/base/text.h"
#include "app/reports/notes.h"
#include "core/gpu/egl_context.h"
#include "core/render/image_output.h"
#include "core/render/renderer.h"
#include "core/scene/picture_device.h"

namespace meniscus {
namespace {

void check_options(const RenderCommand& command) {
  if (command.stats) throw UsageError("--stats: of one picture only; leave --frames away");
  if (command.aovs && !holds_aovs(command.output.path))
    throw UsageError("--aovs needs .exr outputs; other formats hold colour only");
  if (!command.save_camera.empty() && command.run_camera.moves())
    throw UsageError("--save-camera: a camera that moves is no single one");
  if (command.extent) check_view_options(command.molecule);
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
      film_ = std::make_unique<FilmWriter>(path, command.output.existing(), size, command.frames_per_second);
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

  std::vector<std::string> add(std::uint64_t number, const Framebuffer& picture) {
    if (film_) {
      film_->add(srgb_pixels(picture, command_.background.value_or(glm::vec3(1.0f))));
      return {};
    }
    const std::string path = numbered_->at(number);
    write_image(path, picture, {command_.background, command_.output.existing()});
    return {path};
  }

  void finish() {
    if (film_) film_->finish();
  }

 private:
  const RenderCommand& command_;
  std::optional<NumberedPath> numbered_;
  std::unique_ptr<FilmWriter> film_;
};

/// Makes the pictures of frames, by way of the complete surface or of what the view needs.
class FramePainter {
 public:
  FramePainter(const RenderCommand& command, const FrameRun& frames) : command_(command) {
    if (command.extent)
      view_.emplace(command, frames.structure());
    else
      complete_.emplace(command, frames);
  }

  /// `finish` takes a picture of a frame to where it belongs. Surfaces on the CPU are made at the same time as others,
  /// all else is one picture after another.
  std::vector<FrameWorker> workers(const std::vector<Camera>& cameras, const RenderSettings& settings,
                                   const std::function<MadeFrame(std::uint64_t number, Framebuffer picture)>& finish) {
    if (view_)
      return {[this, &cameras, &settings, &finish](const RunFrame& frame) -> FinishFrame {
        view_->atoms.balls = balls_of(frame.structure);
        return [this, &finish, &camera = cameras[frame.place], &settings, number = frame.number] {
          show(view_->atoms, command_.molecule.surface.probe_radius, *command_.extent, view_->pipeline);
          return finish(number, view_->renderer.render(view_->pipeline, camera, settings));
        };
      }};
    std::vector<FrameWorker> workers;
    for (const auto& builder : complete_->builders)
      workers.push_back([this, builder, &cameras, &settings, &finish](RunFrame frame) -> FinishFrame {
        auto molecule = std::make_shared<const Molecule>(builder->build(std::move(frame.structure)));
        return [this, molecule, &finish, &camera = cameras[frame.place], &settings, number = frame.number] {
          return finish(number, render_objects(complete_->device.renderer(), molecule->objects, camera, settings));
        };
      });
    return workers;
  }

 private:
  const RenderCommand& command_;
  struct Complete {
    Complete(const RenderCommand& command, const FrameRun& frames)
        : device(command.molecule.surface),
          builders(frame_builders(frames, command.molecule, command.frames, kSurfaceBytesPerAtom, device.context())) {}
    PictureDevice device;
    std::vector<std::shared_ptr<MoleculeBuilder>> builders;
  };

  /// What --extent needs.
  struct View {
    View(const RenderCommand& command, const Structure& structure)
        : context(gl_device(command)), atoms(colored_atoms(command.molecule, structure)) {}
    EglContext context;
    ColoredAtoms atoms;
    ViewPipeline pipeline;
    Renderer renderer;
  };

  std::optional<Complete> complete_;  // one of the two
  std::optional<View> view_;
};

}  // namespace

void render_frames(const RenderCommand& command) {
  check_options(command);
  const GivenCameras given = given_cameras(command.picture, command.run_camera);
  FrameRun frames(command.molecule, command.frames);
  tell_run(command.molecule, frames);
  Molecule first;  // what the colours mean does not change with the frames
  first.structure = frames.structure();
  first.color = color_of(command.molecule);
  const PictureLayout layout(command, key_of(first));
  PictureSink sink(command);
  const std::vector<Camera> cameras = run_cameras(layout.size, command.run_camera, given, frames);
  if (!command.save_camera.empty()) {
    OutputFile file(command.save_camera, command.output.existing());
    file.write(camera_json(cameras.front()));
    file.commit();
  }
  FramePainter painter(command, frames);
  const RenderSettings settings = render_settings(command, layout);
  const auto finish = [&](std::uint64_t number, Framebuffer picture) {
    const bool empty = shows_nothing(picture);
    if (layout.legend) picture = layout.legend->add_to(picture, command.background);
    return MadeFrame{sink.add(number, picture), empty};
  };
  run_frames(frames, command.molecule, command.frames, painter.workers(cameras, settings, finish));
  sink.finish();
}

}  // namespace meniscus
