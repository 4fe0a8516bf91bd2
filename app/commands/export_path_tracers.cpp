// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mitsuba` and `pbrt`: write a scene for path tracers, with meshes as fine as the picture needs.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/figure_meshes.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus {
namespace {

struct PathTracerCommand : SceneCommand {
  path_tracers::Renderer renderer = path_tracers::Renderer::mitsuba;
  path_tracers::Material material = path_tracers::Material::matte;
};

path_tracers::SceneTarget target_of(const PathTracerCommand& command, const std::string& name) {
  return {command.renderer, command.scene.output, name, command.existing()};
}

void log_report(const PathTracerCommand& command, const path_tracers::SceneReport& report, double tolerance) {
  log_line(command, fmt::format("{} triangles within {:.4g} Å of the surface, {} spheres, {} cylinders",
                                with_thousands(report.triangles), tolerance, with_thousands(report.spheres),
                                with_thousands(report.cylinders)));
}

// Returns a line for a POSIX shell that renders one scene or the whole run.
std::string render_command(const PathTracerCommand& command, bool of_a_run) {
  const bool mitsuba = command.renderer == path_tracers::Renderer::mitsuba;
  const std::string_view program = mitsuba ? "mitsuba" : "pbrt", ending = mitsuba ? "xml" : "pbrt";
  const std::string folder = shell_word(command.scene.output);
  if (!of_a_run) return fmt::format("cd {} && {} surface.{}", folder, program, ending);
  return fmt::format("cd {} && for scene in surface_*.{}; do {} $scene || break; done", folder, ending, program);
}

// Checks the scene before anything is computed.
void check(const PathTracerCommand& command) {
  const auto is_film = [](const FigureObjectRequest& object) { return object.thickens; };
  if (command.scene.figure.thickens || std::ranges::any_of(command.scene.figure.objects, is_film))
    throw UsageError("--film-opacity: path tracers do not support opacity by viewing angle; leave it out");
  const auto hatched = [](const FigureObjectRequest& object) { return object.cap.hatching > 0.0; };
  if (command.scene.figure.cap.hatching > 0.0 || std::ranges::any_of(command.scene.figure.objects, hatched))
    throw UsageError("--cap-hatching: caps in these scenes are plain; leave it out, or use render or export povray");
  if (command.renderer == path_tracers::Renderer::pbrt && command.scene.molecule.color.of_points())
    throw UsageError(
        "colours of points (--color-map-file, lipophilicity): meshes of pbrt have no vertex colours; use export "
        "mitsuba");
  check_caps_of_map(command.scene, "these scenes have no values of the map on caps");
  check_saved_camera(command);
}

// Writes a scene of one molecule, or one for each frame of the chunk, all with one origin.
void run(const PathTracerCommand& command) {
  check(command);
  FigureRun run(command);
  run.aim(command.scene.picture, true);
  const Scene& requested = run.scene();
  if (run.is_run()) run.save_cameras();
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    const std::uint64_t number = frame.number;
    auto [scene, tolerance] = traced_figure(run, std::move(frame));
    scene.material = command.material;
    const path_tracers::SceneReport report = write_scene(
        scene, target_of(command, run.is_run() ? fmt::format("surface_{:05}", number) : std::string("surface")));
    return [&, report, tolerance = tolerance] {
      if (!run.is_run()) log_report(command, report, tolerance);
      return made_frame(report.files);
    };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  if (std::ranges::any_of(requested.figure.objects, [](const auto& object) { return !object.material.empty(); }))
    log_line(command, "note: the materials of --object are for render; here everything has the material of --material");
  if (!run.is_run()) run.save_cameras();
  std::cout << escaped(render_command(command, run.is_run())) << "\n";
}

void declare(CLI::App& command, path_tracers::Renderer renderer) {
  auto declared = std::make_shared<DeclaredCommand<PathTracerCommand>>(command, traced_properties());
  declared->state.renderer = renderer;
  declared->options.describe_output("Folder to write; created if missing");
  const Property& material = property_of("path_tracers.material");
  declared->options.option("look.material")->description(help_of(material))->check(proposes(words_of(material)));
  command.callback([declared] {
    declared->options.take();
    PathTracerCommand& state = declared->state;
    // The default is the fineness of the picture.
    if (!declared->options.is_given("mesh.tolerance") && !declared->options.is_given("mesh.tolerance_pixels"))
      state.scene.mesh.tolerance_pixels = kPixelsOfACamera;
    using enum path_tracers::Material;
    state.material = meaning_of(state.scene.renderer.material, "path_tracers.material", {matte, plastic, glass, wax});
    run_and_save_scene(state, [&] { run(state); });
  });
}

void declare_mitsuba(CLI::App& command) {
  describe(command,
           "  meniscus export mitsuba 1tii.pdb -o 1tii --color chain     then: cd 1tii; mitsuba surface.xml\n"
           "  meniscus export mitsuba 1tii.pdb -o glass --material glass --size 1920x1080\n"
           "  meniscus export mitsuba adk.psf --trajectory adk.dcd --frames 0-90 -o adk     one scene per frame");
  declare(command, path_tracers::Renderer::mitsuba);
}

void declare_pbrt(CLI::App& command) {
  describe(command,
           "  meniscus export pbrt 1tii.pdb -o 1tii --color chain     then: cd 1tii; pbrt surface.pbrt\n"
           "  meniscus export pbrt 1tii.pdb -o wax --material wax --size 1920x1080\n"
           "  meniscus export pbrt adk.psf --trajectory adk.dcd --frames 0-90 -o adk     one scene per frame");
  declare(command, path_tracers::Renderer::pbrt);
}

const ExportCommand kMitsuba(
    "mitsuba", "Write a Mitsuba 3 scene: meshes as fine as the picture needs, exact spheres and cylinders",
    declare_mitsuba);
const ExportCommand kPbrt("pbrt",
                          "Write a pbrt-v4 scene: meshes as fine as the picture needs, exact spheres and cylinders",
                          declare_pbrt);

}  // namespace
}  // namespace meniscus
