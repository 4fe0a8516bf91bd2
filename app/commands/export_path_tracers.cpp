// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mitsuba` and `meniscus export pbrt`: a scene for renderers that follow paths of light, with meshes
// as fine as the picture.
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_export.h"
#include "app/options/camera_file.h"
#include "app/options/figure_command.h"
#include "app/options/mesh_options.h"
#include "app/options/property_options.h"
#include "app/options/scene_file.h"
#include "app/options/value_words.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/copies.h"
#include "exporters/blender/capped_mesh.h"
#include "exporters/path_tracers/scene_folder.h"
#include "exporters/path_tracers/scene_items.h"

namespace meniscus {
namespace {

struct PathTracerCommand : FigureCommand {
  path_tracers::Renderer renderer = path_tracers::Renderer::mitsuba;
  MeshRequest mesh{0.01, kPixelsOfACamera};
  path_tracers::Material material = path_tracers::Material::matte;
};

path_tracers::Scene empty_scene(const PathTracerCommand& command, const Camera& camera, const glm::dvec3& origin) {
  path_tracers::Scene scene;
  scene.origin = origin;
  scene.camera = camera;
  scene.width = command.picture.width;
  scene.height = command.picture.height;
  scene.material = command.material;
  return scene;
}

path_tracers::SceneTarget target_of(const PathTracerCommand& command, const std::string& name) {
  return {command.renderer, command.output.path, name, command.output.existing()};
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
  const blender::CappedMesh shown = blender::capped_mesh(object, planes, cap.color.has_value(), tolerance);
  std::optional<path_tracers::CapRows> caps;
  if (!planes.empty()) caps = {shown.cap_plane.size(), cap.color};
  return path_tracers::surface_item(object, shown.mesh, origin, caps);
}

void add_surface(const PathTracerCommand& command, std::vector<SurfaceObject> objects, double tolerance,
                 path_tracers::Scene& scene) {
  const std::vector<ClipPlane> planes = surface_planes(command.figure, scene.camera, objects);
  if (!planes.empty()) settle_copies(objects);
  for (const SurfaceObject& object : objects)
    scene.items.push_back(item_of(object, planes, command.figure.cap, tolerance, scene.origin));
}

// What stands beside the surface with looks of its own.
void add_more(const PathTracerCommand& command, const Figure& figure, std::span<const Atom> atoms, double tolerance,
              path_tracers::Scene& scene) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    if (!object.surface) {
      scene.items.push_back(path_tracers::shapes_item(atoms, object.shapes, scene.origin));
      continue;
    }
    const PictureObject shown = picture_object(object, command.figure.objects[n], scene.camera, balls);
    scene.items.push_back(item_of(*object.surface, shown.clip, shown.cap, tolerance, scene.origin));
  }
}

void tell(const PathTracerCommand& command, const path_tracers::SceneReport& report, double tolerance) {
  say(command.molecule, fmt::format("{} triangles within {:.4g} Å of the surface, {} spheres, {} cylinders",
                                    with_thousands(report.triangles), tolerance, with_thousands(report.spheres),
                                    with_thousands(report.cylinders)));
}

// A line of a POSIX shell, for one scene or for all of a run.
std::string render_command(const PathTracerCommand& command, bool of_a_run) {
  const bool mitsuba = command.renderer == path_tracers::Renderer::mitsuba;
  const std::string_view program = mitsuba ? "mitsuba" : "pbrt", ending = mitsuba ? "xml" : "pbrt";
  const std::string folder = shell_word(command.output.path);
  if (!of_a_run) return fmt::format("cd {} && {} surface.{}", folder, program, ending);
  return fmt::format("cd {} && for scene in surface_*.{}; do {} $scene || break; done", folder, ending, program);
}

// A scene for each frame of the chunk, all with one origin.
void run_sequence(const PathTracerCommand& asked) {
  PathTracerCommand command = asked;
  ExportRun run(command);
  const Camera& first = run.framing().cameras.front();
  const double tolerance =
      tolerance_of(command.mesh, command.picture.size(), first, balls_of(run.frames().structure()));
  save_camera(command.save_camera, command.output.existing(), first);
  run.run(kMeshBytesPerAtom, [&](MoleculeBuilder& builder, RunFrame frame) -> FinishFrame {
    Molecule molecule = builder.build(std::move(frame.structure));
    path_tracers::Scene scene = empty_scene(command, run.camera(frame.place), run.framing().origin());
    add_surface(command, std::move(molecule.objects), tolerance, scene);
    scene.items.push_back(path_tracers::shapes_item(shown_atoms(molecule.structure), molecule.beside, scene.origin));
    const path_tracers::SceneReport report =
        write_scene(scene, target_of(command, fmt::format("surface_{:05}", frame.number)));
    return [files = report.files] { return made_frame(files); };
  });
  std::cout << escaped(render_command(command, true)) << "\n";
}

// Before anything is computed.
void check(const PathTracerCommand& command) {
  const auto is_film = [](const FigureObjectRequest& object) { return object.thickens; };
  if (command.figure.thickens || std::ranges::any_of(command.figure.objects, is_film))
    throw UsageError(
        "--film-opacity: opacity by the angle of the view is nothing that path tracers know; leave it away");
  const auto hatched = [](const FigureObjectRequest& object) { return object.cap.hatching > 0.0; };
  if (command.figure.cap.hatching > 0.0 || std::ranges::any_of(command.figure.objects, hatched))
    throw UsageError("--cap-hatching: caps in these scenes are plain; leave it away, or use render or export povray");
  if (command.renderer == path_tracers::Renderer::pbrt && command.molecule.color.by == ColorScheme::By::volume)
    throw UsageError("--color-map-file: meshes of pbrt have no colours of their vertices; use export mitsuba");
  check_caps_of_map(command, "these scenes have no values of the map on caps");
  check_export(command, "");
}

void run(const PathTracerCommand& command) {
  check(command);
  if (command.frames.asked()) return run_sequence(command);
  AimedFigure aimed = aimed_figure(command);
  Figure& figure = aimed.figure;
  Molecule& molecule = figure.molecule;
  const std::vector<Ball> balls = figure.balls();
  const Camera camera = aimed.camera(command, command.picture);
  const double tolerance = tolerance_of(command.mesh, command.picture.size(), camera, balls);
  path_tracers::Scene scene = empty_scene(command, camera, middle_of(balls));
  const std::vector<Atom> atoms = shown_atoms(molecule.structure);
  scene.items.push_back(path_tracers::shapes_item(atoms, figure.beside.shapes, scene.origin));
  add_more(command, figure, atoms, tolerance, scene);
  if (!command.figure.hides_surface) add_surface(command, std::move(molecule.objects), tolerance, scene);
  const path_tracers::SceneReport report = write_scene(scene, target_of(command, "surface"));
  tell(command, report, tolerance);
  if (std::ranges::any_of(command.figure.objects, [](const auto& object) { return !object.material.empty(); }))
    say(command.molecule, "note: materials of --object are those of render; here they are all --material");
  save_camera(command.save_camera, command.output.existing(), camera);
  std::cout << escaped(render_command(command, false)) << "\n";
}

void declare(CLI::App& command, path_tracers::Renderer renderer) {
  auto state = std::make_shared<PathTracerCommand>();
  state->renderer = renderer;
  add_shown_options(command, *state);
  add_mesh_options(command, state->mesh);
  add_run_options(command, *state);
  add_scene_options(command, &state->save_scene);
  add_output_options(command, state->output, "Folder to write; made when missing");
  using enum path_tracers::Material;
  PropertyOptions(command).add_word("path_tracers.material", state->material, {matte, plastic, glass, wax});
  add_save_camera_option(command, state->save_camera);
  command.callback([state, &command] {
    take_tolerance(command, state->mesh);
    run_export(command, *state, [&] { run(*state); });
  });
}

}  // namespace

void add_export_mitsuba(CLI::App& command) {
  describe(command, "Write a Mitsuba 3 scene: meshes as fine as the picture, spheres and cylinders as they are",
           "  meniscus export mitsuba 1tii.pdb -o 1tii --color chain     then: cd 1tii; mitsuba surface.xml\n"
           "  meniscus export mitsuba 1tii.pdb -o glass --material glass --size 1920x1080\n"
           "  meniscus export mitsuba adk.psf --trajectory adk.dcd --frames 0-90 -o adk     a scene a frame");
  declare(command, path_tracers::Renderer::mitsuba);
}

void add_export_pbrt(CLI::App& command) {
  describe(command, "Write a pbrt-v4 scene: meshes as fine as the picture, spheres and cylinders as they are",
           "  meniscus export pbrt 1tii.pdb -o 1tii --color chain     then: cd 1tii; pbrt surface.pbrt\n"
           "  meniscus export pbrt 1tii.pdb -o wax --material wax --size 1920x1080\n"
           "  meniscus export pbrt adk.psf --trajectory adk.dcd --frames 0-90 -o adk     a scene a frame");
  declare(command, path_tracers::Renderer::pbrt);
}

}  // namespace meniscus
