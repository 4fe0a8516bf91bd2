// SPDX-License-Identifier: BSD-3-Clause
// Takes a figure to where its exporter begins.
#include "app/commands/figure_export.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/options/camera_file.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/queries/copies.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/surface_kind.h"

namespace meniscus {

void check_export(const FigureCommand& command, std::string_view program) {
  check_camera_file(command.save_camera, command.output.existing());
  if (!command.frames.asked()) return;
  if (!command.save_camera.empty() && command.run_camera.moves()) throw UsageError(kNoSingleCamera);
  if (!command.figure.objects.empty() || command.figure.hides_surface)
    throw UsageError(
        fmt::format("--object and --hide-surface: a run of frames{} has the surface, and beside it --sticks, --balls, "
                    "--spheres and --tube; export its frames one by one (--model), or use render",
                    program));
  if (command.molecule.interface) throw UsageError("--interface: of one picture only; leave --frames away");
}

void check_caps_of_map(const FigureCommand& command, std::string_view reason) {
  if (command.molecule.color.by != ColorScheme::By::volume) return;
  if (!command.figure.cuts.empty() && !command.figure.cap.color)
    throw UsageError(fmt::format("--color-map-file with --clip needs --cap-color: {}", reason));
  for (const FigureObjectRequest& object : command.figure.objects)
    if (!object.shapes && !object.color && !object.cuts.empty() && !object.cap.color)
      throw UsageError(fmt::format("--color-map-file with a \"clip\" in --object needs its \"cap_color\": {}", reason));
}

Camera AimedFigure::camera(const FigureCommand& command, const ViewRequest& picture) const {
  const Camera camera = aim.camera(picture, given, figure.molecule.objects);
  for (const std::string& sentence : idle_cuts(command.figure, figure, camera))
    say(command.molecule, "note: --clip " + sentence);
  return camera;
}

void tell_idle_cuts(const FigureCommand& command, const FrameRun& frames, const Camera& camera) {
  if (command.figure.cuts.empty() || command.figure.hides_surface) return;
  const Structure& structure = frames.structure();
  const SurfaceRequest& surface = command.molecule.surface;
  std::vector<Ball> balls = grown(balls_of(structure), growth_of(surface.kind, surface.probe_radius));
  if (!structure.instances.empty()) balls = reaching_balls(balls, structure.instances);
  for (const std::string& sentence : idle_cuts(command.figure.cuts, camera, balls, balls))
    say(command.molecule, fmt::format("note: --clip {}, in the first frame of the run", sentence));
}

AimedFigure aimed_figure(const FigureCommand& command) {
  const std::optional<Camera> given = given_camera(command.picture);
  auto [molecule, aim] = load_aimed_molecule(command.molecule, command.picture, given);
  return {make_figure(std::move(molecule), command.figure), std::move(aim), given};
}

void settle_copies(std::vector<SurfaceObject>& objects) {
  if (std::ranges::none_of(objects, [](const SurfaceObject& object) { return object.copies.size() > 1; })) return;
  SurfaceObject whole = merged(std::move(objects));
  objects.clear();
  objects.push_back(std::move(whole));
}

MadeFrame made_frame(std::span<const std::filesystem::path> files) {
  MadeFrame made;
  for (const std::filesystem::path& file : files) made.files.push_back(file.string());
  return made;
}

ExportRun::ExportRun(FigureCommand& command, bool velocities)
    : ExportRun(with_settled_selections(command), given_cameras(command.picture, command.run_camera), velocities) {}

ExportRun::ExportRun(FigureCommand& command, const GivenCameras& cameras, bool velocities)
    : command_(command), frames_(command.molecule, command.frames, velocities) {
  tell_run(command.molecule, frames_);
  framing_ = run_framing(command.picture, command.molecule.show, command.run_camera, cameras, frames_);
  measure_colors(command.molecule.color, frames_);
  tell_idle_cuts(command, frames_, framing_.cameras.front());
}

const Camera& ExportRun::camera(std::uint64_t place) const {
  return framing_.cameras[framing_.cameras.size() == 1 ? 0 : place];
}

void ExportRun::run(std::uint64_t bytes_per_atom, const MakeFrame& make) {
  const std::vector<std::shared_ptr<MoleculeBuilder>> builders =
      frame_builders(frames_, command_.molecule, command_.frames, bytes_per_atom * frames_.structure().atoms.size());
  std::vector<FrameWorker> workers;
  for (const std::shared_ptr<MoleculeBuilder>& builder : builders)
    workers.push_back([&make, builder](RunFrame frame) { return make(*builder, std::move(frame)); });
  run_frames(frames_, command_.molecule, command_.frames, std::move(workers));
  tell_beyond_map(command_.molecule, builders);
}

}  // namespace meniscus
