// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render --extent`: pictures by the GPU, from atoms to pixels, without the complete surface.
#include "core/gpu/egl_context.h"

#ifdef MENISCUS_WITH_GL

#include <iostream>

#include <fmt/ostream.h>

#include "app/commands/command_run.h"
#include "app/commands/picture_sink.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "app/reports/run_frames.h"
#include "core/base/text.h"
#include "core/color/color_schemes.h"
#include "core/render/gl_renderer.h"
#include "core/render/picture.h"
#include "core/render/picture_file.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/run_framing.h"
#include "core/scene/surface_objects.h"
#include "core/scene/view_aim.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {
namespace {

/// The atoms of a structure with their colours, without a surface. Throws InputError.
struct ColoredAtoms {
  Molecule molecule;  ///< without objects
  std::vector<Ball> balls;
  Coloring coloring;
};

double milliseconds(const std::vector<StageTime>& times, std::initializer_list<std::string_view> names) {
  double sum = 0.0;
  for (const StageTime& time : times)
    if (std::ranges::find(names, time.name) != names.end()) sum += time.milliseconds;
  return sum;
}

/// Throws UsageError for options that need a complete surface, and for --device cpu.
void check_view_options(const MoleculeRequest& request) {
  const auto refuse = [](const char* option) {
    throw UsageError("{} needs the complete surface; leave --extent out", option);
  };
  if (request.surface.cpu)
    throw UsageError("--extent needs GL; leave out --device cpu, or --extent: the picture is the same");
  if (request.division.groups || request.division.components) refuse("--by");
  if (request.division.cavities != Cavities::keep) refuse("--cavities");
  if (request.division.instances != InstanceMode::none) refuse("--instances");
  if (request.color.by == ColorScheme::By::component) refuse("--color component");
  if (request.color.by == ColorScheme::By::buried || request.interface) refuse("--color buried");
  if (request.color.by == ColorScheme::By::accessibility) refuse("--color relative-accessibility");
  if (request.color.by == ColorScheme::By::volume) refuse("--color-map-file");
  if (request.color.by == ColorScheme::By::lipophilicity) refuse("--color lipophilicity");
  if (request.patches && request.least_patch > 0.0)
    throw UsageError("--patches of a least area need the complete surface; add --min-patch 0, or leave --extent out");
  if (request.surface.verify) refuse("--verify");
  if (request.surface.kind != SurfaceKind::ses) refuse("--surface sas or vdw");
}

ColoredAtoms colored_atoms(const MoleculeRequest& request, const ColorScheme& color, Structure molecule) {
  ColoredAtoms atoms;
  atoms.molecule.structure = std::move(molecule);
  atoms.molecule.color = color;
  const Structure& structure = atoms.molecule.structure;
  atoms.balls = balls_of(structure);
  std::vector<std::uint32_t> all(structure.atoms.size());
  std::iota(all.begin(), all.end(), 0u);
  atoms.coloring = color_object(structure, all, atoms.molecule.color, 0);
  if (request.show) atoms.coloring.hidden = hidden_atoms(*request.show, structure);
  if (request.patches) atoms.coloring.in_patch = patch_atoms(*request.patches, structure);
  return atoms;
}

/// Sets the atoms and the surface of the next pictures of `view`.
void show(const ColoredAtoms& atoms, double probe_radius, Extent extent, ViewPipeline& view) {
  view.set_atoms(atoms.balls);
  view.set_coloring(atoms.coloring);
  view.set_surface(probe_radius, extent);
}

/// Returns the times of the four groups of stages and of ray casting, line by line, with the results of each.
std::string stats_text(const ViewStats& n, const std::vector<StageTime>& times, glm::ivec2 picture_size) {
  const auto line = [](const char* name, double ms, const std::string& found) {
    return fmt::format("  {:<34} {:>9.2f} ms   {}\n", name, ms, found);
  };
  return line("1 visible atoms", milliseconds(times, {"upload", "visible atoms"}),
              fmt::format("{} of {} atoms can matter for a pixel", with_thousands(n.kept_atoms),
                          with_thousands(n.atoms))) +
         line("2 neighbours and potential arcs", milliseconds(times, {"neighbors", "circles", "doubtful circles"}),
              fmt::format("{} circles, {} decided again in double, {} on the host; {} arcs (RS edges)",
                          with_thousands(n.circles.pairs), with_thousands(n.circles.decided_in_double),
                          with_thousands(n.circles.decided_in_quadruple), with_thousands(n.arcs))) +
         line("3 visible and cutting RS faces", milliseconds(times, {"fixed probes"}),
              fmt::format("{} fixed probes", with_thousands(n.probes))) +
         line("4 primitives and singularities", milliseconds(times, {"primitives"}),
              fmt::format("{} patches", with_thousands(n.primitives))) +
         line("ray casting", milliseconds(times, {"tile lists", "ray cast"}),
              fmt::format("{}x{} pixels", picture_size.x, picture_size.y));
}

/// The atoms of the molecule, or of a frame of a run, and their cameras.
struct Viewed {
  std::unique_ptr<FrameRun> run;
  std::unique_ptr<ShownFrames> frames;
  ColoredAtoms atoms;
  GivenCameras given;
  std::optional<ViewAim> aim;

  explicit Viewed(RenderCommand& command) : given(given_cameras(command.scene.picture, command.scene.run_camera)) {
    Scene& scene = command.scene;
    if (!scene.frames.is_requested()) {
      atoms = colored_atoms(scene.molecule, color_of(scene.molecule), read_and_log(command));
      aim.emplace(scene.picture, scene.molecule.show, atoms.molecule.structure);
      return;
    }
    run = std::make_unique<FrameRun>(scene.molecule, scene.frames);
    frames = std::make_unique<ShownFrames>(scene.molecule, *run);
    log_run(command, *run);
    measure_colors(scene.molecule.color, *frames);
  }

  ColorKey key(const Scene& scene) const {
    if (run) return key_of(*run, scene);
    DrawnAtoms drawn;
    for (std::uint32_t a = 0; a < atoms.balls.size(); ++a) drawn.atoms.push_back(atoms.coloring.shows(a));
    return color_key(atoms.molecule.structure, atoms.molecule.color, drawn);
  }

  std::vector<Camera> cameras(const Scene& scene, const ViewRequest& size) {
    if (!run) return {aim->camera(size, given.still, atoms.balls)};
    return run_cameras(size, scene.run_camera, given, *frames);
  }
};

}  // namespace

void render_views(const RenderCommand& requested) {
  check_view_options(requested.scene.molecule);
  RenderCommand command = requested;
  Scene& scene = command.scene;
  freeze_selections(scene);
  Viewed viewed(command);
  const PictureLayout layout(scene, viewed.key(scene));
  const std::vector<Camera> cameras = viewed.cameras(scene, layout.size);
  PictureSink sink(requested, layout, viewed.run.get());
  if (viewed.run) sink.check(cameras, viewed.frames->first_shown());
  const EglContext context(scene.molecule.surface.gl);
  ViewPipeline pipeline;
  GlRenderer renderer;
  double grown_by = 0.0;
  const auto keep = [&](const SinkPicture& picture) {
    show(viewed.atoms, scene.molecule.surface.probe_radius, *scene.image.extent, pipeline);
    return sink.keep(picture, sink.annotations(picture, viewed.atoms.molecule.structure),
                     [&](const RenderSettings& settings) {
                       Framebuffer drawn = renderer.render(pipeline, picture.camera, settings);
                       grown_by = std::max(grown_by, pipeline.stats().grown_by);
                       return drawn;
                     });
  };
  const auto stats = [&] { return stats_text(pipeline.stats(), renderer.times(), layout.size.size()); };
  if (viewed.run) {
    const ColorScheme color = color_of(scene.molecule);
    run_frames(*viewed.run, command, {[&](RunFrame frame) -> FinishFrame {
      viewed.atoms = colored_atoms(scene.molecule, color, std::move(frame.structure));
      const FinishFrame finish = keep({frame.number, frame.place, frame.source, frame.time, cameras[frame.place]});
      if (!command.stats) return finish;
      return [finish, text = fmt::format("frame {}\n{}", frame.number, stats())] {
        fmt::print(std::cerr, "{}", text);
        return finish();
      };
    }});
  } else if (keep({.camera = cameras.front()})().shows_nothing) {
    log_line(command, kShowsNothing);
  }
  sink.finish();
  log_grown_radii(command, grown_by);
  if (layout.legend_apart) write_legend_picture(scene.legend.file, *layout.legend_apart, image_settings(requested));
  save_cameras(command, cameras, viewed.run ? std::span(viewed.run->numbers()) : std::span<const std::uint64_t>());
  if (viewed.run) return;
  if (command.stats) fmt::print(std::cerr, "{}", stats());
  log_times(command, gl_words(context), renderer.times());
}

}  // namespace meniscus

#else

namespace meniscus {

void render_views(const RenderCommand& command) {
  const EglContext context(command.scene.molecule.surface.gl);  // throws: this build has no GL
}

}  // namespace meniscus

#endif
