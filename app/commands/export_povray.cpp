// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray`: a folder with a POV-Ray scene of the analytic patches.
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_export.h"
#include "app/options/camera_file.h"
#include "app/options/figure_command.h"
#include "app/options/property_options.h"
#include "app/options/scene_file.h"
#include "app/options/value_words.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/volume_paint.h"
#include "core/queries/copies.h"
#include "exporters/povray/scene.h"
#include "exporters/povray/sequence.h"

namespace meniscus {
namespace {

struct PovrayCommand : FigureCommand {
  bool comments = false;  // that tell kinds and atoms
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

// Whatever atoms are meant by rules in other frames. Nothing if colours change with the frames.
std::optional<std::vector<povray::SceneColor>> colors_of_run(const PovrayCommand& command, const ColorScheme& scheme,
                                                             const FrameRun& frames, const Coloring& beside) {
  if (scheme.changes_with_frames()) return {};
  const std::vector<glm::vec3> colors = run_colors(frames.reach(), scheme, beside);
  povray::ColorTable all;
  const auto add = [&](const povray::SceneColor& color) {
    if (color.opacity > 0.0f) all.number(color);
  };
  std::vector<float> opacities{1.0f};
  for (const OpacityRule& rule : command.molecule.color.opacities) opacities.push_back(rule.opacity);
  const bool film = command.figure.thickens, caps = !command.figure.cuts.empty();
  for (const float opacity : opacities) {
    if (scheme.volume) {
      add({scheme.volume->scale.missing_color, opacity, true, film});
      if (caps) add({scheme.volume->scale.missing_color, opacity, true});
    }
    for (const glm::vec3& color : colors) {
      add({color, opacity, false, film});
      if (caps) add({color, opacity});
    }
    if (caps && command.figure.cap.color) add({*command.figure.cap.color, opacity});
  }
  return all.colors();
}

// Of all atoms of the structure, if comments shall tell them.
std::vector<std::string> comment_names(const PovrayCommand& command, const Structure& structure) {
  std::vector<std::string> names;
  if (!command.comments) return names;
  names.reserve(structure.atoms.size());
  for (const Atom& atom : structure.atoms) {
    if (atom.residue_name.empty()) {  // as --csv and selections number it
      names.push_back(fmt::format("{} index {}", atom.name, atom.index));
      names.back().erase(0, names.back().find_first_not_of(' '));
      continue;
    }
    const std::string code = atom.insertion_code == ' ' ? std::string() : std::string(1, atom.insertion_code);
    names.push_back(fmt::format("{} {} {}{} {}", atom.chain, atom.residue_name, atom.residue_number, code, atom.name));
    names.back().erase(0, names.back().find_first_not_of(' '));
  }
  return names;
}

// What stands beside the surface with looks of its own.
std::vector<povray::SceneObject> more_objects(const Figure& figure, const FigureRequest& request, const Camera& camera,
                                              std::span<const Ball> balls) {
  std::vector<povray::SceneObject> more;
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    const PictureObject shown = picture_object(object, request.objects[n], camera, balls);
    povray::SceneObject& made = more.emplace_back();
    if (object.surface)
      made.surface = &*object.surface;
    else
      made.shapes = &object.shapes;
    made.cut = {shown.clip, shown.cap};
    made.film = shown.thickens;
    made.material = shown.material;
  }
  return more;
}

// An include for each frame of the chunk; the scene for all of the run, the same from every chunk.
void run_sequence(const PovrayCommand& asked) {
  PovrayCommand command = asked;
  ExportRun run(command);
  const FrameRun& frames = run.frames();
  const RunFraming& framing = run.framing();
  const ColorScheme scheme = color_of(command.molecule);
  povray::SceneOptions options = scene_options(command);
  options.origin = framing.origin();
  if (command.comments && frames.atoms_change())
    throw UsageError(
        "--comments names the atoms of all frames once, but --select means others in each; add --select-once");
  options.atom_names = comment_names(command, frames.structure());
  options.colors = color_key(frames.reach(), scheme, {});
  const ColoredShapes beside = shown_shapes(frames.reach(), command.molecule.representations, scheme);
  const bool translucent = std::ranges::any_of(
      scheme.opacities, [](const OpacityRule& rule) { return rule.opacity > 0.0f && rule.opacity < 1.0f; });
  const povray::SequenceScene scene(
      {frames.numbers(), framing.cameras, colors_of_run(command, scheme, frames, beside.coloring), framing.low,
       framing.high, !beside.empty(), !command.figure.cuts.empty(), translucent, scheme.volume},
      options, command.output.path);
  const povray::SceneReport shared = scene.write_shared();
  save_camera(command.save_camera, command.output.existing(), framing.cameras.front());
  bool noted = false;
  const auto finish = [&](const povray::SceneReport& report, std::uint64_t number) {
    // Notes of later frames would differ in their numbers only.
    if (!noted)
      for (const std::string& note : report.notes)
        say(command.molecule, fmt::format("note: frame {}: {}", number, note));
    noted = noted || !report.notes.empty();
    return made_frame(report.files);
  };
  run.run(kSurfaceBytesPerAtom, [&](MoleculeBuilder& builder, RunFrame frame) -> FinishFrame {
    const Molecule molecule = builder.build(std::move(frame.structure));
    const povray::SceneReport report =
        scene.write_frame(molecule.objects, frame.place, molecule.beside,
                          surface_planes(command.figure, run.camera(frame.place), molecule.objects));
    return [&finish, report, number = frame.number] { return finish(report, number); };
  });
  std::cout << escaped(shared.command) << "\n";
}

// Before anything is computed.
void check(const PovrayCommand& command) {
  if (command.figure.thickens && command.molecule.volume_offset != 0.0)
    throw UsageError(
        "--map-offset: POV-Ray samples beside the surface patch by patch, not in a film; leave "
        "--film-opacity away, or the offset");
  check_export(command, " in POV-Ray");
}

void run(const PovrayCommand& command) {
  check(command);
  if (command.frames.asked()) return run_sequence(command);
  const AimedFigure aimed = aimed_figure(command);
  const Figure& figure = aimed.figure;
  const std::vector<SurfaceObject>& objects = figure.molecule.objects;
  povray::SceneOptions options = scene_options(command);
  options.colors = key_of(figure.molecule);
  options.atom_names = comment_names(command, figure.molecule.structure);
  const Camera camera = aimed.camera(command, command.picture);
  options.shapes = &figure.beside.shapes;
  options.objects = more_objects(figure, command.figure, camera, placed_balls(objects));
  options.cut.planes = surface_planes(command.figure, camera, objects);
  if (command.figure.hides_surface && figure.beside.shapes.empty() && options.objects.empty())
    throw RequestError("the surface is not shown, and there is nothing beside it");
  const povray::SceneReport report = write_scene(
      command.figure.hides_surface ? std::span<const SurfaceObject>{} : objects, camera, options, command.output.path);
  say(command.molecule,
      fmt::format("{} primitives in {} files", with_thousands(report.object_count), report.files.size()));
  for (const std::string& note : report.notes) say(command.molecule, "note: " + note);
  save_camera(command.save_camera, command.output.existing(), camera);
  std::cout << escaped(report.command) << "\n";
}

}  // namespace

void add_export_povray(CLI::App& command) {
  describe(
      command, "Write a POV-Ray scene of the analytic patches, no triangles; prints how to render it",
      "  meniscus export povray 1tii.pdb -o 1tii                 then: cd 1tii; povray surface.ini\n"
      "  meniscus export povray 1tii.pdb -o glass --material glass --size 1920x1080\n"
      "  meniscus export povray 1tii.pdb -o cut --clip 'depth>0.5' --color chain --sticks 'chain C'\n"
      "  meniscus export povray --scene fig.json -o fig           all of a figure; see meniscus help scenes\n"
      "  meniscus export povray 1tii.pdb -o 1tii --camera camera.json --color chain --force\n"
      "  meniscus export povray adk.psf --trajectory adk.dcd --frames 0-90 -o adk      then: povray surface.ini",
      "Of a run of frames the folder holds one scene and an include for each frame; POV-Ray's frames and pictures\n"
      "have the numbers of the trajectory. Machines that share the work give the same options and --only, and render\n"
      "with +SF and +EF. povray 'surface.ini[film]' goes through a run in any order and counts pictures from 1.");
  auto state = std::make_shared<PovrayCommand>();
  add_shown_options(command, *state);
  add_run_options(command, *state);
  add_scene_options(command, &state->save_scene);
  add_output_options(command, state->output, "Folder to write; made when missing");
  using enum povray::Material;
  PropertyOptions options(command);
  options.add_word("povray.material", state->material, {opaque, ghost, glass, wax, flat});
  options.add("look.comments", state->comments);
  add_save_camera_option(command, state->save_camera);
  command.callback([state, &command] { run_export(command, *state, [&] { run(*state); }); });
}

}  // namespace meniscus
