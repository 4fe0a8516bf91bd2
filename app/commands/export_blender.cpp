// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export blender`: writes mesh, analytic patches, atoms and camera as one .mns file.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "app/commands/buried_attribute.h"
#include "app/commands/commands.h"
#include "app/commands/figure_run.h"
#include "app/commands/mesh_notes.h"
#include "app/options/scene_options.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/section_mesh.h"
#include "core/mesh/shape_mesh.h"
#include "core/mesh/velocity.h"
#include "core/queries/copies.h"
#include "core/scene/copied_atoms.h"
#include "exporters/blender/mns_file.h"
#include "exporters/blender/sequence_manifest.h"
#include "exporters/blender/surface_file.h"
#include "exporters/blender/surface_numbers.h"
#include "exporters/mesh_files/vertex_numbers.h"

namespace meniscus {
namespace {

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

blender::Shot shot_of(const Scene& scene, const Camera& camera) {
  return {camera, scene.picture.width, scene.picture.height, scene.look.shadows.value_or(0.0f),
          scene.look.shadow_softness.value_or(0.0f)};
}

blender::SequenceManifest manifest_of(FigureRun& run) {
  const Scene& scene = run.scene();
  const FrameRun& frames = run.frames();
  blender::SequenceManifest manifest;
  manifest.provenance = {file_name(frames.structure().file), frames.structure().radii_set, {}, run.key()};
  for (const std::string& path : scene.frames.trajectories)
    manifest.trajectory += (manifest.trajectory.empty() ? "" : ", ") + file_name(path);
  manifest.frames = frames.numbers();
  for (const Camera& camera : run.framing().cameras) manifest.shots.push_back(shot_of(scene, camera));
  manifest.origin = run.framing().origin();
  manifest.fps = scene.film.frames_per_second;
  manifest.probe_radius = scene.molecule.surface.probe_radius;
  if (scene.mesh.density == 0.0)
    manifest.tolerance = tolerance_of(scene.mesh, scene.picture.size(), run.camera(0), standing_balls(run.structure()));
  manifest.atom_count = frames.structure().atoms.size();
  return manifest;
}

blender::CutFile cut_file(const SceneCommand& command, const FigureFrame& frame) {
  const Figure& figure = frame.figure;
  return {surface_planes(command.scene.figure, figure.beside.cut_atoms, frame.camera, figure.molecule.objects),
          command.scene.figure.cap};
}

// Cut, with caps.
std::vector<blender::MeshedObject> cut_objects(const SceneCommand& command, Molecule& molecule,
                                               const blender::CutFile& cut, double tolerance) {
  settle_copies(molecule.objects);
  std::vector<blender::MeshedObject> objects;
  for (const SurfaceObject& object : molecule.objects) {
    CappedMesh made = capped_mesh(object, cut.planes, cut.style.color.has_value(), tolerance);
    objects.push_back({object,
                       std::move(made.mesh),
                       blender::atom_attributes(molecule.structure, object.atom),
                       {},
                       command.scene.figure.thickens,
                       std::move(made.cap_plane)});
  }
  return objects;
}

// How the vertices of one object move.
std::vector<glm::dvec3> velocities_of(const SurfaceObject& object, const TriangleMesh& mesh,
                                      std::span<const glm::dvec3> velocities) {
  std::vector<glm::dvec3> atoms;
  for (const std::uint32_t atom : object.atom) atoms.push_back(velocities[atom]);
  return vertex_velocities(object.surface, mesh, atoms);
}

// Whole; with velocities if there are some.
std::vector<blender::MeshedObject> whole_objects(const SceneCommand& command, const Molecule& molecule,
                                                 const MeshFineness& fineness, std::span<const glm::dvec3> velocities) {
  std::vector<blender::MeshedObject> objects;
  for (const SurfaceObject& object : molecule.objects) {
    FineMesh made = fine_mesh(object.surface, fineness);
    if (object.coloring.hides_some()) made = {shown_part(std::move(made.mesh), object.coloring), {}, {}};
    std::vector<glm::dvec3> moving;
    if (!velocities.empty()) moving = velocities_of(object, made.mesh, velocities);
    objects.push_back({object, std::move(made.mesh), blender::atom_attributes(molecule.structure, object.atom),
                       std::move(moving), command.scene.figure.thickens});
    objects.back().vertex_face = std::move(made.vertex_face);
  }
  return objects;
}

// Meshes of what is drawn beside the surface with looks of its own, kept in `made`.
void add_more(const SceneCommand& command, const Figure& figure, const Camera& camera, double tolerance,
              std::vector<ShapeObject>& made, std::vector<blender::MeshedObject>& objects) {
  Structure shown;
  shown.atoms = shown_atoms(figure.molecule.structure);
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  made.reserve(figure.beside.objects.size());  // objects refer to them
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    const PictureObject asked = picture_object(object, command.scene.figure.objects[n], camera, balls);
    std::vector<std::uint32_t> cap_plane;
    if (!object.surface) {
      made.push_back(shape_object(shown.atoms, object.shapes, tolerance));
    } else {
      CappedMesh capped = capped_mesh(*object.surface, asked.clip, asked.cap.color.has_value(), tolerance);
      cap_plane = std::move(capped.cap_plane);
      made.push_back({*object.surface, std::move(capped.mesh)});
    }
    SurfaceObject& own = made.back().object;
    own.name = fmt::format("object {}", n + 1);
    TriangleMesh& mesh = made.back().mesh;
    if (!object.surface && own.coloring.hides_some()) mesh = shown_part(std::move(mesh), own.coloring);
    objects.push_back({own,
                       std::move(mesh),
                       blender::atom_attributes(shown, own.atom),
                       {},
                       asked.thickens,
                       std::move(cap_plane),
                       blender::CutFile{asked.clip, asked.cap},
                       asked.material});
  }
}

// An object more for what is drawn beside the surface, kept in `made`. Its vertices move with the atom of their
// triangles.
void add_beside(const Structure& structure, const ColoredShapes& shapes, double tolerance,
                std::span<const glm::dvec3> velocities, std::optional<ShapeObject>& made,
                std::vector<blender::MeshedObject>& objects) {
  if (shapes.empty()) return;
  Structure shown;
  shown.atoms = shown_atoms(structure);
  made = shape_object(shown.atoms, shapes, tolerance);
  std::vector<glm::dvec3> moving;
  if (!velocities.empty())
    for (const std::uint32_t atom : vertex_atoms(made->mesh)) moving.push_back(velocities[made->object.atom[atom]]);
  objects.push_back({made->object, made->mesh, blender::atom_attributes(shown, made->object.atom), std::move(moving)});
}

// Of all objects what --attributes asks for. Returns what had to be left out.
std::string add_numbers(const SceneCommand& command, blender::SurfaceNumbers wanted, const Structure& structure,
                        std::vector<blender::MeshedObject>& objects) {
  const std::vector<double> buried =
      buried_by_chains(command.scene.molecule, structure, wanted.names, command.scene.mesh.attributes == "all");
  std::string left_out;
  for (blender::MeshedObject& object : objects) {
    const std::string note = blender::add_surface_numbers(object, wanted, buried);
    if (left_out.empty()) left_out = note;
  }
  return left_out;
}

// What all files of a run share; of one molecule there is none.
struct Sequence {
  blender::SequenceManifest manifest;
  std::string name;
  std::filesystem::path written;
};

// All meshes of one figure, and what they refer to.
struct FigureMeshes {
  std::optional<ShapeObject> beside;
  std::vector<ShapeObject> more;
  std::vector<blender::MeshedObject> objects;
};

bool is_empty(const std::vector<blender::MeshedObject>& objects) {
  return std::ranges::all_of(objects, [](const blender::MeshedObject& each) { return each.mesh.triangles.empty(); });
}

// Shapes and objects with looks of their own keep to patches, within fineness.tolerance.
void mesh_figure(const SceneCommand& command, FigureFrame& frame, const blender::CutFile& cut,
                 const MeshFineness& fineness, FigureMeshes& made) {
  Molecule& molecule = frame.figure.molecule;
  const BesideSurface& beside = frame.figure.beside;
  // Where planes cut, vertices have no velocities: caps stay where they are.
  const std::span<const glm::dvec3> velocities =
      cut.planes.empty() ? std::span<const glm::dvec3>(frame.velocities) : std::span<const glm::dvec3>{};
  if (!command.scene.figure.hides_surface) {
    const bool hides =
        std::ranges::any_of(molecule.objects, [](const SurfaceObject& o) { return o.coloring.hides_some(); });
    refuse_even_parts(fineness, hides, !cut.planes.empty());
    made.objects = cut.planes.empty() ? whole_objects(command, molecule, fineness, velocities)
                                      : cut_objects(command, molecule, cut, fineness.tolerance);
    if (beside.empty() && is_empty(made.objects))
      throw RequestError("no part of the surface is shown, so there is no mesh to write");
  }
  add_beside(molecule.structure, beside.shapes, fineness.tolerance, velocities, made.beside, made.objects);
  add_more(command, frame.figure, frame.camera, fineness.tolerance, made.more, made.objects);
  if (is_empty(made.objects)) throw RequestError("the surface is not shown, and there is nothing beside it");
}

std::string megabytes(double bytes) {
  return bytes < 1e6 ? fmt::format("{:.2g} MB", bytes / 1e6) : fmt::format("{:.3g} MB", bytes / 1e6);
}

// How large a file will be, and those of a run (frames > 0) if all are like it.
void tell_size(const SceneCommand& command, const FigureMeshes& meshes, const MeshFineness& fineness, double bytes,
               std::size_t frames) {
  std::size_t triangles = 0;
  for (const blender::MeshedObject& object : meshes.objects) triangles += object.mesh.triangles.size();
  say(command, fmt::format("{} triangles {}, {}{}", with_thousands(triangles),
                           fineness_words(command.scene.mesh, fineness), megabytes(bytes),
                           frames == 0 ? ""
                                       : fmt::format(" a frame; about {} for {} frames",
                                                     megabytes(bytes * static_cast<double>(frames)), frames)));
}

// A file of one molecule, or one for each frame of the chunk beside a manifest for all of the run, the same from every
// chunk.
void export_to_blender(const SceneCommand& asked) {
  check_caps_of_map(asked.scene, "a .mns file has no values of the map on caps");
  check_saved_camera(asked);
  const blender::SurfaceNumbers numbers = blender::parse_surface_numbers(asked.scene.mesh.attributes);
  FigureRun run(asked, true);
  run.aim(asked.scene.picture, true);
  const SceneCommand& command = run.command();
  const Scene& scene = command.scene;
  std::optional<Sequence> sequence;
  if (run.is_run()) {
    sequence.emplace(Sequence{manifest_of(run), {}, {}});
    sequence->name = run_name(sequence->manifest);
    sequence->written = write_manifest(scene.output, command.existing(), sequence->manifest);
  }
  const std::size_t frames = sequence ? run.frames().chunk().size() : 0;
  if (sequence) save_camera(command, run.camera(0));
  std::once_flag told, warned, told_size;
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    Molecule& molecule = frame.figure.molecule;
    blender::Provenance provenance{file_name(molecule.structure.file), molecule.structure.radii_set, molecule.device,
                                   key_of(molecule)};
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
      const std::vector<Ball> beside = balls_around(frame.figure.beside.shapes.shapes);
      balls.insert(balls.end(), beside.begin(), beside.end());
      if (fineness.density == 0.0)
        fineness = fineness_of(scene.mesh, scene.mesh.even, 0.0, scene.picture.size(), frame.camera, balls);
    }
    const blender::CutFile cut = cut_file(command, frame);
    FigureMeshes meshes;
    std::call_once(
        warned, [&] { warn_of_many(command, expected_triangles(molecule.objects, fineness, CopiesOfMesh::shared)); });
    mesh_figure(command, frame, cut, fineness, meshes);
    const std::string left_out = add_numbers(command, numbers, molecule.structure, meshes.objects);
    if (!left_out.empty()) std::call_once(told, [&] { say(command, left_out); });
    write_objects(path, command.existing(), meshes.objects, shot_of(scene, frame.camera), provenance, place, cut,
                  [&](std::uint64_t bytes) {
                    std::call_once(told_size,
                                   [&] { tell_size(command, meshes, fineness, static_cast<double>(bytes), frames); });
                  });
    return [path] { return MadeFrame{{path}}; };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  if (!sequence) save_camera(command, run.camera(0));
  std::cout << escaped(sequence ? sequence->written.string() : scene.output) << "\n";
}

}  // namespace

void add_export_blender(CLI::App& command) {
  describe(command,
           "  meniscus export blender 1tii.pdb -o 1tii.mns\n"
           "  meniscus export blender 1tii.pdb -o 1tii.mns --camera camera.json --tolerance-pixels 0.25 "
           "--size 1920x1080\n"
           "  meniscus export blender adk.psf --trajectory adk.dcd --frames all -o adk   one file per frame, and a "
           "manifest\n"
           "  meniscus export blender 1tii.pdb -o 1tii.mns --density 1   even triangles, for modifiers and sculpting",
           "The default tolerance is half a pixel of --camera; without a camera it is 0.05 Å.");
  auto declared = std::make_shared<DeclaredCommand<>>(command, for_blender);
  declared->options.describe_output(".mns file to write; for frames, a folder");
  declared->options.option("mesh.attributes")
      ->description(
          "Numbers of the surface, separated by commas: usual (exact curvature, areas of atoms and patches), all, "
          "none, or the names of export mesh [usual]");
  const Property& tolerance = property_of("mesh.tolerance");
  declared->options.option(tolerance.key)->description(fmt::format("{} [{:g}]", tolerance.help, blender::kTolerance));
  declared->options.option("frames.fps")->description("Frames per second of a run [25]");
  command.callback([declared] {
    declared->options.take();
    Scene& scene = declared->state.scene;
    if (!has_fineness(declared->options)) {
      if (scene.picture.camera_file.empty())
        scene.mesh.tolerance = blender::kTolerance;
      else
        scene.mesh.tolerance_pixels = kPixelsOfACamera;
    }
    run_and_save_scene(declared->state, [&] { export_to_blender(declared->state); });
  });
}

}  // namespace meniscus
