// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render --extent`: pictures by the GPU, from atoms to pixels, without the complete surface.
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/picture_sink.h"
#include "app/commands/render_command.h"
#include "app/commands/view_picture.h"
#include "app/options/camera_file.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "app/reports/run_frames.h"
#include "core/gpu/egl_context.h"
#include "core/render/renderer.h"
#include "core/scene/run_cameras.h"
#include "core/scene/run_framing.h"
#include "core/scene/settled_selections.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

void say_times(const RenderCommand& command, const std::string& device, const std::vector<StageTime>& stages) {
  std::string times;
  for (const StageTime& stage : stages)
    times += fmt::format("{}{} {:.1f} ms", times.empty() ? "" : ", ", stage.name, stage.milliseconds);
  say(command, fmt::format("picture on {}: {}", device, times));
}

/// The atoms of the molecule, or of the first frame of a run, and the cameras that see them.
struct Viewed {
  std::unique_ptr<FrameRun> run;
  ColoredAtoms atoms;
  GivenCameras given;
  std::optional<ViewAim> aim;

  explicit Viewed(RenderCommand& command) : given(given_cameras(command.scene.picture, command.scene.run_camera)) {
    Scene& scene = command.scene;
    if (!scene.frames.asked()) {
      atoms = colored_atoms(scene.molecule, read_and_tell(command));
      aim.emplace(scene.picture, scene.molecule.show, atoms.molecule.structure);
      return;
    }
    run = std::make_unique<FrameRun>(scene.molecule, scene.frames);
    tell_run(command, *run);
    measure_colors(scene.molecule.color, *run);
    if (scene.molecule.color.changes_with_frames())
      throw UsageError("colours that change from frame to frame need the complete surface; leave --extent away");
    if (selects_by_positions(scene.molecule))
      throw UsageError(
          "--extent: what a selection by distance means changes from frame to frame; add --select-once, or leave "
          "--extent away");
    atoms = colored_atoms(scene.molecule, run->structure());
  }

  ColorKey key(const Scene& scene) const {
    return run ? color_key(run->reach(), color_of(scene.molecule), {}) : key_of(atoms.molecule);
  }

  std::vector<Camera> cameras(const Scene& scene, const ViewRequest& size) {
    if (!run) return {aim->camera(size, given.still, atoms.balls)};
    return run_cameras(size, scene.molecule.show, scene.run_camera, given, *run);
  }
};

}  // namespace

void render_views(const RenderCommand& asked) {
  check_view_options(asked.scene.molecule);
  RenderCommand command = asked;
  Scene& scene = command.scene;
  settle_selections(scene.molecule, scene.frames, {.view = &scene.picture, .motion = &scene.run_camera});
  Viewed viewed(command);
  const PictureLayout layout(scene, viewed.key(scene));
  const std::vector<Camera> cameras = viewed.cameras(scene, layout.size);
  PictureSink sink(asked, layout, viewed.run.get());
  const EglContext context(scene.molecule.surface.gl);
  ViewPipeline pipeline;
  Renderer renderer;
  const auto keep = [&](const SinkPicture& picture) {
    show(viewed.atoms, scene.molecule.surface.probe_radius, *scene.image.extent, pipeline);
    return sink.keep(
        picture, sink.annotations(picture, viewed.atoms.molecule.structure),
        [&](const RenderSettings& settings) { return renderer.render(pipeline, picture.camera, settings); });
  };
  if (viewed.run) {
    run_frames(*viewed.run, command, {[&](const RunFrame& frame) -> FinishFrame {
      viewed.atoms.balls = balls_of(frame.structure);
      return keep({frame.number, frame.place, frame.source, frame.time, cameras[frame.place]});
    }});
  } else if (keep({.camera = cameras.front()})().shows_nothing) {
    say(command, kShowsNothing);
  }
  sink.finish();
  if (layout.legend_alone) write_image(scene.legend.file, *layout.legend_alone, image_settings(asked));
  save_camera(command.save_camera, command.existing(), cameras.front());
  if (viewed.run) return;
  if (command.stats) fmt::print(std::cerr, "{}", stats_text(pipeline.stats(), renderer.times(), layout.size.size()));
  say_times(command, gl_words(context), renderer.times());
}

}  // namespace meniscus
