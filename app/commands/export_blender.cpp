// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export blender`: writes mesh, analytic patches, atoms and camera as one .mns file.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/figure_meshes.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/copies.h"
#include "exporters/blender/mns_file.h"
#include "exporters/blender/sequence_manifest.h"
#include "exporters/blender/surface_file.h"

namespace meniscus {
namespace {

blender::SequenceManifest manifest_of(FigureRun& run) {
  const Scene& scene = run.scene();
  const FrameRun& frames = run.frames();
  blender::SequenceManifest manifest;
  manifest.provenance = {file_name(frames.structure().file), frames.structure().radii_set, {}, run.key()};
  for (const std::string& path : scene.frames.trajectories)
    manifest.trajectory += (manifest.trajectory.empty() ? "" : ", ") + file_name(path);
  manifest.frames = frames.numbers();
  for (const Camera& camera : run.framing().cameras) manifest.shots.push_back(blender_shot(scene, camera));
  manifest.origin = run.framing().origin();
  manifest.fps = scene.film.frames_per_second;
  manifest.probe_radius = scene.molecule.surface.probe_radius;
  if (scene.mesh.density == 0.0)
    manifest.tolerance = tolerance_of(scene.mesh, scene.picture.size(), run.camera(0), standing_balls(run.structure()));
  manifest.atom_count = frames.structure().atoms.size();
  return manifest;
}

// The common part of all files of a run; a single molecule has none.
struct Sequence {
  blender::SequenceManifest manifest;
  std::string name;
  std::filesystem::path written;
};

std::string bytes_text(double bytes) {
  if (bytes >= 999.5e6) return fmt::format("{:.3g} GB", bytes / 1e9);
  return bytes < 1e6 ? fmt::format("{:.2g} MB", bytes / 1e6) : fmt::format("{:.3g} MB", bytes / 1e6);
}

// Prints the size of a file, and of a run (frames > 0) if all its files are alike.
void log_size(const SceneCommand& command, const FigureMeshes& meshes, const MeshFineness& fineness, double bytes,
              std::size_t frames) {
  std::size_t triangles = 0;
  for (const blender::MeshedObject& object : meshes.objects) triangles += object.mesh.triangles.size();
  const double all = bytes * static_cast<double>(frames);
  constexpr double kLargeRun = 1e9;
  log_line(command,
           fmt::format("{} triangles {}, {}{}{}", with_thousands(triangles),
                       fineness_words(command.scene.mesh, fineness), bytes_text(bytes),
                       frames == 0 ? "" : fmt::format(" a frame; about {} for {} frames", bytes_text(all), frames),
                       all < kLargeRun ? "" : "; fewer --frames, or a larger --tolerance, make it smaller"));
}

// Writes a file of one molecule, or a file for each frame of the chunk and a manifest for the whole run.
void export_to_blender(const SceneCommand& requested) {
  check_blender(requested.scene);
  if (requested.scene.output.ends_with(".blend"))
    throw UsageError("{}: Blender writes .blend files; name this one .mns, and import it with the add-on",
                     requested.scene.output);
  check_saved_camera(requested);
  const blender::SurfaceNumbers numbers = blender::parse_surface_numbers(requested.scene.mesh.attributes);
  FigureRun run(requested, Velocities::central);
  run.aim(requested.scene.picture, true);
  const SceneCommand& command = run.command();
  const Scene& scene = command.scene;
  std::optional<Sequence> sequence;
  if (run.is_run()) {
    sequence.emplace(Sequence{manifest_of(run), {}, {}});
    sequence->name = run_name(sequence->manifest);
    sequence->written = write_manifest(scene.output, command.existing(), sequence->manifest);
  }
  const std::size_t frames = sequence ? run.frames().chunk().size() : 0;
  if (sequence) run.save_cameras();
  std::once_flag left_out_logged, warned, size_logged;
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    Molecule& molecule = frame.figure.molecule;
    blender::Provenance provenance = provenance_of(molecule);
    MeshFineness fineness{blender::kTolerance, {}, scene.mesh.density, scene.mesh.even};
    std::string path = scene.output;
    std::optional<blender::PlaceInRun> place;
    if (sequence) {
      if (fineness.density == 0.0) fineness.tolerance = sequence->manifest.tolerance;
      path = (std::filesystem::path(scene.output) / blender::frame_file(frame.number)).string();
      place = {sequence->name, frame.number, frame.place + 1};
      provenance.source = sequence->manifest.provenance.source;
      provenance.radii_set = sequence->manifest.provenance.radii_set;
    } else {
      std::vector<Ball> balls = placed_balls(molecule.objects);
      const std::vector<Ball> extras = balls_around(frame.figure.extras.shapes.shapes);
      balls.insert(balls.end(), extras.begin(), extras.end());
      if (fineness.density == 0.0)
        fineness = fineness_of(scene.mesh, scene.mesh.even, 0.0, scene.picture.size(), frame.camera, balls);
    }
    const blender::CutFile cut = cut_file(command, frame);
    FigureMeshes meshes;
    std::call_once(
        warned, [&] { warn_of_many(command, expected_triangles(molecule.objects, fineness, CopiesOfMesh::shared)); });
    mesh_figure(command, frame, cut, fineness, meshes);
    const std::string left_out = add_numbers(command, numbers, molecule.structure, meshes.objects);
    if (!left_out.empty()) std::call_once(left_out_logged, [&] { log_line(command, left_out); });
    write_objects(path, command.existing(), meshes.objects, blender_shot(scene, frame.camera), provenance, place, cut,
                  [&](std::uint64_t bytes) {
                    std::call_once(size_logged,
                                   [&] { log_size(command, meshes, fineness, static_cast<double>(bytes), frames); });
                  });
    return [path] { return MadeFrame{{path}}; };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  if (!sequence) run.save_cameras();
  std::cout << escaped(sequence ? sequence->written.string() : scene.output) << "\n";
}

void declare_blender(CLI::App& command) {
  describe(command,
           "  meniscus export blender 1tii.pdb -o 1tii.mns\n"
           "  meniscus export blender 1tii.pdb -o 1tii.mns --camera camera.json --tolerance-pixels 0.25 "
           "--size 1920x1080\n"
           "  meniscus export blender adk.psf --trajectory adk.dcd --frames all -o adk   one file per frame, and a "
           "manifest\n"
           "  meniscus export blender 1tii.pdb -o 1tii.mns --density 1   even triangles, for modifiers and sculpting",
           "The default tolerance is half a pixel of --camera; without a camera it is 0.1 Å, of frames 0.2 Å.");
  auto declared = std::make_shared<DeclaredCommand<>>(command, blender_properties());
  declared->options.describe_output(".mns file to write; for frames, a folder");
  declared->options.option("mesh.attributes")
      ->description(
          "Numbers of the surface, separated by commas: usual (exact curvature, areas of atoms and patches), all, "
          "none, or the names of export mesh [usual]");
  const Property& tolerance = property_of("mesh.tolerance");
  declared->options.option(tolerance.key)
      ->description(
          fmt::format("{} [{:g}; of frames {:g}]", tolerance.help, blender::kTolerance, blender::kRunTolerance));
  declared->options.option("frames.fps")->description("Frames per second of a run [25]");
  command.callback([declared] {
    declared->options.take();
    Scene& scene = declared->state.scene;
    if (!has_fineness(declared->options)) {
      if (scene.picture.camera_file.empty())
        scene.mesh.tolerance = scene.frames.is_requested() ? blender::kRunTolerance : blender::kTolerance;
      else
        scene.mesh.tolerance_pixels = kPixelsOfACamera;
    }
    run_and_save_scene(declared->state, [&] { export_to_blender(declared->state); });
  });
}

const ExportCommand kBlender(
    "blender", "Write a file for Blender: closed mesh, analytic patches, atoms, camera (add-on: meniscus_import)",
    declare_blender);

}  // namespace
}  // namespace meniscus
