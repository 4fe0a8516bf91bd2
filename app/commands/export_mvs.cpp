// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mvs`: writes a view for Mol* and other viewers of MolViewSpec.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/figure_meshes.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "exporters/mvs/mvs_state.h"

namespace meniscus {
namespace {

constexpr double kLargeArchive = 50e6;

/// Refuses settings that such a view cannot have, before anything is computed.
void check(const SceneCommand& command) {
  const Scene& scene = command.scene;
  const auto refuse = [](const char* option, const char* why) {
    throw UsageError("{}: MolViewSpec has no {}; leave it out, or use export page", option, why);
  };
  const auto is_film = [](const FigureObjectRequest& object) { return object.thickens; };
  const auto is_hatched = [](const FigureObjectRequest& object) { return object.cap.hatching > 0.0; };
  const std::vector<FigureObjectRequest>& objects = scene.figure.objects;
  if (scene.figure.thickens || std::ranges::any_of(objects, is_film))
    refuse("--film-opacity", "opacity by viewing angle");
  if (scene.figure.cap.hatching > 0.0 || std::ranges::any_of(objects, is_hatched)) refuse("--cap-hatching", "hatching");
  if (!scene.renderer.material.empty()) refuse("--material", "materials");
  check_caps_of_map(scene, "these views have no values of the map on caps");
  check_output(scene.output, command.existing());
  check_saved_camera(command);
}

std::string title_of(const Scene& scene) { return text_of_path(path_of_text(scene.molecule.file).filename()); }

void run(const SceneCommand& requested) {
  check(requested);
  FigureRun run(requested);
  run.aim(requested.scene.picture, true);
  const SceneCommand& command = run.command();
  std::vector<mvs::State> states;
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    const std::string title = fmt::format("{}, frame {}", title_of(command.scene), frame.number);
    const TracedFigure made = traced_figure(run, std::move(frame));
    auto state = std::make_shared<mvs::State>(mvs::State{mvs::tree_of(made.scene), title});
    std::size_t triangles = 0;
    for (const path_tracers::SceneItem& item : made.scene.items)
      for (const path_tracers::SceneMesh& mesh : item.meshes) triangles += mesh.triangles.size();
    return [&, state, triangles, tolerance = made.tolerance] {
      if (!run.is_run())
        log_line(command,
                 fmt::format("{} triangles within {:.4g} Å of the surface", with_thousands(triangles), tolerance));
      states.push_back(std::move(*state));
      return MadeFrame{};
    };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  const int milliseconds = static_cast<int>(std::lround(1e3 / command.scene.film.frames_per_second));
  const std::vector<std::byte> archive =
      mvs::mvsx_archive(states, title_of(command.scene), {run.is_run(), milliseconds});
  OutputFile file(command.scene.output, command.existing());
  file.write(archive);
  file.commit();
  if (static_cast<double>(archive.size()) > kLargeArchive)
    log_line(command,
             fmt::format("warning: {} bytes, all of which viewers load; a larger --tolerance makes fewer triangles",
                         with_thousands(archive.size())));
  run.save_cameras();
  std::cout << escaped(command.scene.output) << "\n";
}

void declare_mvs(CLI::App& command) {
  describe(
      command,
      "  meniscus export mvs 1tii.pdb -o 1tii.mvsx --color chain     then drop it into https://molstar.org/viewer\n"
      "  meniscus export mvs 1hpv.pdb -o pocket.mvsx --look-into ligand\n"
      "  meniscus export mvs adk.psf adk.dcd --frames 0-90:10 -o adk.mvsx     a state for each frame",
      "The view has the mesh in the colours of the figure, cut with its caps, what is drawn beside it, and the camera. "
      "Viewers light it\nin their own way, and shade each triangle flat.");
  auto declared = std::make_shared<DeclaredCommand<>>(
      command, traced_properties().with({}, {{{"image.width", "image.height"},
                                              [](const GivenScene& given) {
                                                return !given.any({"mesh.tolerance"}) ||
                                                       (given.any({"image.width"}) && given.any({"image.height"}));
                                              },
                                              "viewers choose the size, and --tolerance says how fine the mesh is"}}));
  declared->options.describe_output("MolViewSpec archive to write (.mvsx)");
  command.callback([declared] {
    declared->options.take();
    Scene& scene = declared->state.scene;
    if (!declared->options.is_given("mesh.tolerance") && !declared->options.is_given("mesh.tolerance_pixels"))
      scene.mesh.tolerance_pixels = kPixelsOfACamera;
    run_and_save_scene(declared->state, [&] { run(declared->state); });
  });
}

const ExportCommand kMvs("mvs",
                         "Write a view for Mol* and other viewers of MolViewSpec (.mvsx): mesh, colours, caps, camera",
                         declare_mvs);

}  // namespace
}  // namespace meniscus
