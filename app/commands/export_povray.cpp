// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray`: writes a folder with a POV-Ray scene of the analytic patches.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/povray_figures.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/queries/copies.h"
#include "exporters/povray/povray_scene.h"

namespace meniscus {
namespace {

// Returns one table of colours for all frames: all colours that any rule can give to any atom. Nothing if each frame
// needs a table of its own, because colours change from frame to frame, or objects have colours of their own. Places in
// a chain are those among the atoms of a frame.
std::optional<std::vector<povray::SceneColor>> colors_of_run(const Scene& requested, const ColorScheme& scheme,
                                                             const Structure& possible, const Coloring& extras,
                                                             bool atoms_change) {
  if ((atoms_change && resolved_scheme(possible, scheme).uses(ColorScheme::By::rainbow)) ||
      scheme.changes_with_frames() || requested.figure.hides_surface || !requested.figure.objects.empty() ||
      possible.companions == Companions::drawn)
    return {};
  const std::vector<glm::vec3> colors = run_colors(possible, scheme, extras);
  povray::ColorTable all;
  const auto add = [&](const povray::SceneColor& color) {
    if (color.opacity > 0.0f) all.number(color);
  };
  std::vector<float> opacities{1.0f};
  for (const OpacityRule& rule : requested.molecule.color.opacities) opacities.push_back(rule.opacity);
  const bool film = requested.figure.thickens, caps = !requested.figure.cuts.empty();
  for (const float opacity : opacities) {
    if (scheme.volume) {
      add({scheme.volume->scale.missing_color, opacity, true, film});
      if (caps) add({scheme.volume->scale.missing_color, opacity, true});
    }
    for (const glm::vec3& color : colors) {
      add({color, opacity, false, film});
      if (caps) add({color, opacity});
    }
    if (caps && requested.figure.cap.color) add({*requested.figure.cap.color, opacity});
  }
  return all.colors();
}

// Returns the common part of all frames of a run: one scene, the same from every chunk.
povray::SequenceScene sequence_of(FigureRun& run, povray::SceneOptions options) {
  const Scene& requested = run.scene();
  const FigureRequest& figure = requested.figure;
  const Structure possible = numbered_structure(run.frames());
  const ColorScheme scheme = color_of(requested.molecule);
  options.origin = run.framing().origin();
  const ColoredShapes extras = shown_shapes(possible, figure.representations, scheme);
  const auto sees_through = [](const OpacityRule& rule) { return rule.opacity > 0.0f && rule.opacity < 1.0f; };
  povray::Run shared{run.frames().numbers(), run.framing().cameras,
                     colors_of_run(requested, scheme, possible, extras.coloring, run.frames().atoms_change()),
                     run.framing().extent.shown};
  shared.surface = !figure.hides_surface;
  shared.shapes = !extras.empty();
  shared.caps = shared.surface && !figure.cuts.empty();
  shared.translucent = std::ranges::any_of(scheme.opacities, sees_through);
  shared.map = scheme.volume;
  shared.maps_change = scheme.by == ColorScheme::By::lipophilicity;
  for (const FigureObjectRequest& object : all_requests(figure.objects, possible)) {
    shared.objects.push_back({!object.shapes, false});
    if (!object.material.empty()) shared.materials.push_back(object.material);
    shared.translucent = shared.translucent || std::ranges::any_of(object.opacities, sees_through);
  }
  return povray::SequenceScene(std::move(shared), options, requested.output);
}

// Writes the scene of one molecule, or the part of the run's scene for this frame.
povray::SceneReport write_figure(const Scene& requested, povray::SceneOptions options, const FigureFrame& frame,
                                 const povray::SequenceScene* sequence) {
  const Figure& figure = frame.figure;
  const std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const std::vector<povray::SceneObject> more =
      povray_objects(figure, requested.figure, frame.camera, sequence != nullptr);
  const std::span<const SurfaceObject> surface =
      requested.figure.hides_surface ? std::span<const SurfaceObject>{} : objects;
  options.cut = povray_cut(figure, requested.figure, frame.camera);
  options.atom_names = comment_names(requested, figure.molecule.structure);
  if (sequence)
    return sequence->write_frame(frame.place, {surface, options.cut, &figure.extras.shapes, more, options.atom_names});
  options.shapes = &figure.extras.shapes;
  options.objects = more;
  if (requested.figure.hides_surface && figure.extras.shapes.empty() && more.empty())
    throw RequestError("the surface is not shown, and there is nothing beside it");
  return write_scene(surface, frame.camera, options, requested.output);
}

void export_to_povray(const SceneCommand& command) {
  check_povray(command.scene);
  check_saved_camera(command);
  povray::SceneOptions options = povray_options(command.scene, command.existing());
  FigureRun run(command);
  run.aim(command.scene.picture, true);
  const Scene& requested = run.scene();
  options.colors = run.key();
  std::optional<povray::SequenceScene> sequence;
  std::string render_command;
  if (run.is_run()) {
    sequence.emplace(sequence_of(run, options));
    render_command = sequence->write_shared().command;
  }
  run.save_cameras();
  bool noted = false;
  const auto finish = [&](const povray::SceneReport& report, std::uint64_t number) {
    if (!sequence) {
      log_line(command,
               fmt::format("{} primitives in {} files", with_thousands(report.object_count), report.files.size()));
      render_command = report.command;
    }
    // Notes of later frames would differ only in their numbers.
    if (!noted)
      for (const std::string& note : report.notes)
        log_line(command, sequence ? fmt::format("note: frame {}: {}", number, note) : "note: " + note);
    noted = noted || !report.notes.empty();
    return made_frame(report.files);
  };
  run.make({kSurfaceBytesPerAtom}, [&]() -> FigureRun::Sink {
    return [&](const FigureFrame& frame) -> FinishFrame {
      const povray::SceneReport report = write_figure(requested, options, frame, sequence ? &*sequence : nullptr);
      return [&finish, report, number = frame.number] { return finish(report, number); };
    };
  });
  std::cout << escaped(render_command) << "\n";
}

void declare_povray(CLI::App& command) {
  describe(command,
           "  meniscus export povray 1tii.pdb -o 1tii                 then: cd 1tii; povray surface.ini\n"
           "  meniscus export povray 1tii.pdb -o glass --material glass --size 1920x1080\n"
           "  meniscus export povray 1tii.pdb -o cut --clip 'depth>0.5' --color chain --sticks 'chain C'\n"
           "  meniscus export povray --scene fig.json -o fig           all of a figure; see meniscus help scenes\n"
           "  meniscus export povray 1tii.pdb -o 1tii --camera camera.json --color chain --force\n"
           "  meniscus export povray adk.psf --trajectory adk.dcd --frames 0-90 -o adk      then: povray surface.ini",
           "For a run of frames the folder holds one scene and one include file per frame; POV-Ray's frames and "
           "pictures\nhave the numbers of the trajectory. To share the work among machines, give each the same options "
           "and its --only, and\nrender with +SF and +EF. povray 'surface.ini[film]' renders a run in any order and "
           "counts pictures from 1.");
  auto declared = std::make_shared<DeclaredCommand<>>(command, povray_properties());
  declared->options.describe_output("Folder to write; created if missing");
  const Property& material = property_of("povray.material");
  declared->options.option("look.material")->description(help_of(material))->check(proposes(words_of(material)));
  command.callback([declared] {
    declared->options.take();
    run_and_save_scene(declared->state, [&] { export_to_povray(declared->state); });
  });
}

const ExportCommand kPovray("povray", "Write a POV-Ray scene of the exact patches, without triangles", declare_povray);

}  // namespace
}  // namespace meniscus
