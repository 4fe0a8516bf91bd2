// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mitsuba` and `meniscus export pbrt`: write a scene for path tracers, with meshes as fine as the
// picture needs.
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_run.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/copies.h"
#include "core/scene/copied_atoms.h"
#include "exporters/path_tracers/scene_folder.h"

namespace meniscus {
namespace {

struct PathTracerCommand : SceneCommand {
  path_tracers::Renderer renderer = path_tracers::Renderer::mitsuba;
  path_tracers::Material material = path_tracers::Material::matte;
};

path_tracers::Scene empty_scene(const PathTracerCommand& command, const Camera& camera, const glm::dvec3& origin) {
  path_tracers::Scene scene;
  scene.origin = origin;
  scene.camera = camera;
  scene.width = command.scene.picture.width;
  scene.height = command.scene.picture.height;
  scene.material = command.material;
  return scene;
}

path_tracers::SceneTarget target_of(const PathTracerCommand& command, const std::string& name) {
  return {command.renderer, command.scene.output, name, command.existing()};
}

// To three decimals.
glm::dvec3 middle_of(std::span<const Ball> balls) {
  Box box;
  for (const Ball& ball : balls) box.include(ball.center);
  return glm::round((box.low + box.high) * 0.5e3) / 1e3;
}

// What is shown of a surface, with caps where planes cut it.
path_tracers::SceneItem item_of(const SurfaceObject& object, std::span<const ClipPlane> planes, const CapStyle& cap,
                                double tolerance, const glm::dvec3& origin) {
  const CappedMesh shown = capped_mesh(object, planes, cap.color.has_value(), tolerance);
  std::optional<path_tracers::CapRows> caps;
  if (!planes.empty()) caps = {shown.cap_plane.size(), cap.color};
  return path_tracers::surface_item(object, shown.mesh, origin, caps);
}

void add_surface(const Scene& asked, Figure figure, double tolerance, path_tracers::Scene& scene) {
  std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const std::vector<ClipPlane> planes = surface_planes(asked.figure, figure.beside.cut_atoms, scene.camera, objects);
  if (!planes.empty()) settle_copies(objects);
  for (const SurfaceObject& object : objects)
    scene.items.push_back(item_of(object, planes, asked.figure.cap, tolerance, scene.origin));
}

// What is drawn beside the surface with looks of its own.
void add_more(const Scene& asked, const Figure& figure, std::span<const Atom> atoms, double tolerance,
              path_tracers::Scene& scene) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    if (!object.surface) {
      scene.items.push_back(path_tracers::shapes_item(atoms, object.shapes, scene.origin));
      continue;
    }
    const PictureObject shown = picture_object(object, asked.figure.objects[n], scene.camera, balls);
    scene.items.push_back(item_of(*object.surface, shown.clip, shown.cap, tolerance, scene.origin));
  }
}

void tell(const PathTracerCommand& command, const path_tracers::SceneReport& report, double tolerance) {
  say(command, fmt::format("{} triangles within {:.4g} Å of the surface, {} spheres, {} cylinders",
                           with_thousands(report.triangles), tolerance, with_thousands(report.spheres),
                           with_thousands(report.cylinders)));
}

// A line of a POSIX shell, for one scene or for all of a run.
std::string render_command(const PathTracerCommand& command, bool of_a_run) {
  const bool mitsuba = command.renderer == path_tracers::Renderer::mitsuba;
  const std::string_view program = mitsuba ? "mitsuba" : "pbrt", ending = mitsuba ? "xml" : "pbrt";
  const std::string folder = shell_word(command.scene.output);
  if (!of_a_run) return fmt::format("cd {} && {} surface.{}", folder, program, ending);
  return fmt::format("cd {} && for scene in surface_*.{}; do {} $scene || break; done", folder, ending, program);
}

// Before anything is computed.
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

// A scene of one molecule, or one for each frame of the chunk, all with one origin.
void run(const PathTracerCommand& command) {
  check(command);
  FigureRun run(command);
  run.aim(command.scene.picture, true);
  const Scene& asked = run.scene();
  if (run.is_run()) run.save_cameras();
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    Figure& figure = frame.figure;
    const std::vector<Ball> balls = run.is_run() ? standing_balls(run.structure()) : figure.balls();
    const double tolerance = tolerance_of(asked.mesh, asked.picture.size(), run.camera(0), balls);
    path_tracers::Scene scene =
        empty_scene(command, frame.camera, run.is_run() ? run.framing().origin() : middle_of(balls));
    const std::vector<Atom> atoms = shown_atoms(figure.molecule.structure);
    scene.items.push_back(path_tracers::shapes_item(atoms, figure.beside.shapes, scene.origin));
    add_more(asked, figure, atoms, tolerance, scene);
    if (!asked.figure.hides_surface) add_surface(asked, std::move(figure), tolerance, scene);
    const path_tracers::SceneReport report = write_scene(
        scene, target_of(command, run.is_run() ? fmt::format("surface_{:05}", frame.number) : std::string("surface")));
    return [&, report, tolerance] {
      if (!run.is_run()) tell(command, report, tolerance);
      return made_frame(report.files);
    };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  if (std::ranges::any_of(asked.figure.objects, [](const auto& object) { return !object.material.empty(); }))
    say(command, "note: materials of --object are those of render; here they are all --material");
  if (!run.is_run()) run.save_cameras();
  std::cout << escaped(render_command(command, run.is_run())) << "\n";
}

void declare(CLI::App& command, path_tracers::Renderer renderer) {
  auto declared = std::make_shared<DeclaredCommand<PathTracerCommand>>(command, for_path_tracers);
  declared->state.renderer = renderer;
  declared->options.describe_output("Folder to write; created if missing");
  const Property& material = property_of("path_tracers.material");
  declared->options.option("look.material")->description(help_of(material))->check(proposes(words_of(material)));
  command.callback([declared] {
    declared->options.take();
    PathTracerCommand& state = declared->state;
    // As fine as the picture, unless another tolerance is asked for.
    if (!declared->options.is_given("mesh.tolerance") && !declared->options.is_given("mesh.tolerance_pixels"))
      state.scene.mesh.tolerance_pixels = kPixelsOfACamera;
    using enum path_tracers::Material;
    state.material = meaning_of(state.scene.renderer.material, "path_tracers.material", {matte, plastic, glass, wax});
    run_and_save_scene(state, [&] { run(state); });
  });
}

}  // namespace

void add_export_mitsuba(CLI::App& command) {
  describe(command,
           "  meniscus export mitsuba 1tii.pdb -o 1tii --color chain     then: cd 1tii; mitsuba surface.xml\n"
           "  meniscus export mitsuba 1tii.pdb -o glass --material glass --size 1920x1080\n"
           "  meniscus export mitsuba adk.psf --trajectory adk.dcd --frames 0-90 -o adk     one scene per frame");
  declare(command, path_tracers::Renderer::mitsuba);
}

void add_export_pbrt(CLI::App& command) {
  describe(command,
           "  meniscus export pbrt 1tii.pdb -o 1tii --color chain     then: cd 1tii; pbrt surface.pbrt\n"
           "  meniscus export pbrt 1tii.pdb -o wax --material wax --size 1920x1080\n"
           "  meniscus export pbrt adk.psf --trajectory adk.dcd --frames 0-90 -o adk     one scene per frame");
  declare(command, path_tracers::Renderer::pbrt);
}

}  // namespace meniscus
