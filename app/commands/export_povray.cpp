// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray`: a folder with a POV-Ray scene of the analytic patches.
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/reports/run_frames.h"
#include "core/scene/molecule.h"
#include "app/options/scene_file.h"
#include "app/options/picture_options.h"
#include "app/options/figure_options.h"
#include "app/options/value_words.h"
#include "app/process/program_error.h"
#include "core/scene/run_framing.h"
#include "core/base/text.h"
#include "core/queries/combine.h"
#include "exporters/povray/scene.h"
#include "app/reports/notes.h"
#include "app/options/run_camera_options.h"
#include "app/options/molecule_options.h"
#include "app/options/frame_options.h"
#include "exporters/povray/sequence.h"

namespace meniscus {
namespace {

struct PovrayCommand {
  MoleculeOptions molecule;
  FigureRequest figure;
  FrameOptions frames;
  CameraMotionRequest run_camera;
  ViewRequest picture;
  OutputOptions output;
  povray::Material material = povray::Material::opaque;
};

povray::SceneOptions scene_options(const PovrayCommand& command) {
  povray::SceneOptions options;
  options.width = command.picture.width;
  options.height = command.picture.height;
  options.material = command.material;
  options.existing = command.output.existing();
  options.cut.style = command.figure.cap;
  options.film = command.figure.thickens;
  return options;
}

std::vector<ClipPlane> planes_of(const PovrayCommand& command, const Camera& camera,
                                 std::span<const SurfaceObject> objects) {
  std::vector<ClipPlane> planes;
  if (command.figure.cuts.empty()) return planes;
  const std::vector<Ball> balls = placed_balls(objects);
  for (const Cut& cut : command.figure.cuts) planes.push_back(clip_plane(cut, camera, balls));
  return planes;
}

// Whatever atoms are meant by rules in other frames.
std::vector<glm::vec4> colors_of_run(const PovrayCommand& command, const std::vector<glm::vec3>& colors) {
  std::vector<glm::vec4> all;
  const auto add = [&](const glm::vec3& color, float opacity) {
    const glm::vec4 shown(color, opacity);
    if (opacity > 0.0f && std::ranges::find(all, shown) == all.end()) all.push_back(shown);
  };
  std::vector<float> opacities{1.0f};
  for (const OpacityRule& rule : command.molecule.color.opacities) opacities.push_back(rule.opacity);
  for (const float opacity : opacities) {
    for (const glm::vec3& color : colors) add(color, opacity);
    if (!command.figure.cuts.empty() && command.figure.cap.color) add(*command.figure.cap.color, opacity);
  }
  return all;
}

// An include for each frame of the chunk; the scene for all of the run, the same from every chunk.
void run_sequence(const PovrayCommand& command) {
  const GivenCameras cameras = given_cameras(command.picture, command.run_camera);
  FrameRun frames(command.molecule, command.frames);
  tell_run(command.molecule, frames);
  const RunFraming framing = run_framing(command.picture, command.molecule.show, command.run_camera, cameras, frames);
  const ColorScheme scheme = color_of(command.molecule);
  povray::SceneOptions options = scene_options(command);
  options.origin = framing.origin();
  options.colors = color_key(frames.structure(), scheme, {});
  const ColoredShapes beside = shown_shapes(frames.structure(), command.molecule.representations, scheme);
  const povray::SequenceScene scene({frames.numbers(), framing.cameras,
                                     colors_of_run(command, run_colors(frames.structure(), scheme, beside.coloring)),
                                     framing.low, framing.high, !beside.empty(), !command.figure.cuts.empty()},
                                    options, command.output.path);
  const povray::SceneReport shared = scene.write_shared();
  bool noted = false;
  const auto finish = [&](const povray::SceneReport& report, std::uint64_t number) {
    // Notes of later frames would differ in their numbers only.
    if (!noted)
      for (const std::string& note : report.notes)
        say(command.molecule, fmt::format("note: frame {}: {}", number, note));
    noted = noted || !report.notes.empty();
    std::vector<std::string> files;
    for (const std::filesystem::path& file : report.files) files.push_back(file.string());
    return MadeFrame{std::move(files)};
  };
  std::vector<FrameWorker> workers;
  for (const auto& builder :
       frame_builders(frames, command.molecule, command.frames, kSurfaceBytesPerAtom * frames.structure().atoms.size()))
    workers.push_back([&, builder](RunFrame frame) -> FinishFrame {
      const Molecule molecule = builder->build(std::move(frame.structure));
      const Camera& camera = framing.cameras[framing.cameras.size() == 1 ? 0 : frame.place];
      const povray::SceneReport report = scene.write_frame(molecule.objects, frame.place, molecule.beside,
                                                           planes_of(command, camera, molecule.objects));
      return [&finish, report, number = frame.number] { return finish(report, number); };
    });
  run_frames(frames, command.molecule, command.frames, std::move(workers));
  std::cout << escaped(shared.command) << "\n";
}

void run(const PovrayCommand& command) {
  if (command.molecule.color.by == ColorScheme::By::volume)
    throw UsageError("--color-map-file: a POV-Ray scene has colours of atoms only; use render, or export ply");
  if (command.frames.asked()) return run_sequence(command);
  if (command.run_camera.moves()) throw UsageError(kMovesWithoutFrames);
  const std::optional<Camera> given = given_camera(command.picture);
  const auto [molecule, aim] = load_aimed_molecule(command.molecule, command.picture, given);
  povray::SceneOptions options = scene_options(command);
  options.colors = key_of(molecule);
  const Camera camera = aim.camera(command.picture, given, molecule.objects);
  options.shapes = &molecule.beside;
  options.cut.planes = planes_of(command, camera, molecule.objects);
  const povray::SceneReport report = write_scene(molecule.objects, camera, options, command.output.path);
  say(command.molecule,
      fmt::format("{} primitives in {} files", with_thousands(report.object_count), report.files.size()));
  for (const std::string& note : report.notes) say(command.molecule, "note: " + note);
  std::cout << escaped(report.command) << "\n";
}

}  // namespace

void add_export_povray(CLI::App& command) {
  describe(
      command, "Write a POV-Ray scene of the analytic patches, no triangles; prints how to render it",
      "  meniscus export povray 1tii.pdb -o 1tii                 then: cd 1tii; povray surface.ini\n"
      "  meniscus export povray 1tii.pdb -o glass --material glass --size 1920x1080\n"
      "  meniscus export povray 1tii.pdb -o cut --clip 'depth>0.5' --color chain --sticks 'chain C'\n"
      "  meniscus export povray 1tii.pdb -o 1tii --camera camera.json --color chain --force\n"
      "  meniscus export povray adk.psf --trajectory adk.dcd --frames 0-90:10 -o adk   then: povray surface.ini",
      "Of a run of frames the folder holds one scene and an include for each frame; POV-Ray's frames count from 1.\n"
      "Machines that share the work give the same options and --only, and render with +SF and +EF.");
  auto state = std::make_shared<PovrayCommand>();
  add_molecule_options(command, state->molecule);
  add_figure_options(command, state->molecule, state->figure);
  add_picture_options(command, state->picture);
  add_trajectory_argument(command);
  add_frame_options(command, state->frames);
  add_run_camera_options(command, state->run_camera);
  add_scene_options(command);
  add_output_options(command, state->output, "Folder to write; made when missing");
  const std::map<std::string, povray::Material> words{{"opaque", povray::Material::opaque},
                                                      {"ghost", povray::Material::ghost},
                                                      {"glass", povray::Material::glass},
                                                      {"wax", povray::Material::wax}};
  command.add_option("--material", state->material, "Default material: opaque, ghost, glass, wax; the scene holds all")
      ->transform(one_of(words))
      ->type_name("WORD");
  command.callback([state] {
    state->molecule.representations = state->figure.representations;
    run(*state);
  });
}

}  // namespace meniscus
