// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export blender`: mesh, analytic patches, atoms and camera as one .mns file.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "app/commands/buried_attribute.h"
#include "app/commands/commands.h"
#include "app/commands/figure_export.h"
#include "app/options/figure_command.h"
#include "app/options/mesh_options.h"
#include "app/options/property_options.h"
#include "app/options/scene_file.h"
#include "app/options/value_words.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/shape_mesh.h"
#include "core/mesh/velocity.h"
#include "core/queries/copies.h"
#include "exporters/blender/atom_arrays.h"
#include "exporters/blender/capped_mesh.h"
#include "exporters/blender/sequence_manifest.h"
#include "exporters/blender/surface_file.h"
#include "exporters/blender/surface_numbers.h"
#include "exporters/mesh_files/vertex_numbers.h"

namespace meniscus {
namespace {

struct BlenderCommand : FigureCommand {
  MeshRequest mesh;
  std::string attributes = "usual";
  double fps = 24.0;
};

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

blender::SequenceManifest manifest_of(const BlenderCommand& command, ExportRun& run) {
  const FrameRun& frames = run.frames();
  const RunFraming& framing = run.framing();
  const ColorKey key = color_key(frames.reach(), color_of(command.molecule), {});
  blender::SequenceManifest manifest;
  manifest.provenance = {file_name(frames.structure().file), frames.structure().radii_set, {}, key};
  for (const std::string& path : command.frames.trajectories)
    manifest.trajectory += (manifest.trajectory.empty() ? "" : ", ") + file_name(path);
  manifest.frames = frames.numbers();
  for (const Camera& camera : framing.cameras)
    manifest.shots.push_back({camera, command.picture.width, command.picture.height});
  manifest.origin = framing.origin();
  manifest.fps = command.fps;
  manifest.probe_radius = command.molecule.surface.probe_radius;
  manifest.tolerance =
      tolerance_of(command.mesh, command.picture.size(), framing.cameras[0], balls_of(frames.structure()));
  manifest.atom_count = frames.structure().atoms.size();
  return manifest;
}

blender::CutFile cut_file(const BlenderCommand& command, const Camera& camera, std::span<const SurfaceObject> objects) {
  return {surface_planes(command.figure, camera, objects), command.figure.cap};
}

// Cut, with caps. Throws RequestError if nothing is left, unless it may be.
std::vector<blender::MeshedObject> cut_objects(const BlenderCommand& command, Molecule& molecule,
                                               const blender::CutFile& cut, double tolerance, bool may_be_empty) {
  settle_copies(molecule.objects);
  std::vector<blender::MeshedObject> objects;
  bool any = may_be_empty;
  for (const SurfaceObject& object : molecule.objects) {
    blender::CappedMesh made = blender::capped_mesh(object, cut.planes, cut.style.color.has_value(), tolerance);
    any = any || !made.mesh.triangles.empty();
    objects.push_back({object,
                       std::move(made.mesh),
                       blender::atom_attributes(molecule.structure, object.atom),
                       {},
                       command.figure.thickens,
                       std::move(made.cap_plane)});
  }
  if (!any) throw RequestError("nothing of the surface is shown, so there is no mesh to write");
  return objects;
}

// How the vertices of one object move.
std::vector<glm::dvec3> velocities_of(const SurfaceObject& object, const TriangleMesh& mesh, const RunFrame& frame) {
  std::vector<glm::dvec3> atoms;
  for (const std::uint32_t atom : object.atom) atoms.push_back(frame.velocities[atom]);
  return vertex_velocities(object.surface, mesh, atoms);
}

// Meshes of what stands beside the surface with looks of its own, kept in `made`.
void add_more(const BlenderCommand& command, const Figure& figure, const Camera& camera, double tolerance,
              std::vector<ShapeObject>& made, std::vector<blender::MeshedObject>& objects) {
  Structure shown;
  shown.atoms = shown_atoms(figure.molecule.structure);
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  made.reserve(figure.beside.objects.size());  // objects refer to them
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    const PictureObject asked = picture_object(object, command.figure.objects[n], camera, balls);
    std::vector<std::uint32_t> cap_plane;
    if (!object.surface) {
      made.push_back(shape_object(shown.atoms, object.shapes, tolerance));
    } else {
      blender::CappedMesh capped =
          blender::capped_mesh(*object.surface, asked.clip, asked.cap.color.has_value(), tolerance);
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

// An object more for what is drawn beside the surface, kept in `made`.
void add_beside(const Molecule& molecule, double tolerance, std::optional<ShapeObject>& made,
                std::vector<blender::MeshedObject>& objects) {
  if (molecule.beside.empty()) return;
  Structure shown;
  shown.atoms = shown_atoms(molecule.structure);
  made = shape_object(shown.atoms, molecule.beside, tolerance);
  objects.push_back({made->object, made->mesh, blender::atom_attributes(shown, made->object.atom), {}});
}

// Vertices beside the surface move with the atom of their triangles.
std::vector<glm::dvec3> velocities_of(const ShapeObject& beside, const TriangleMesh& mesh, const RunFrame& frame) {
  std::vector<glm::dvec3> velocities;
  for (const std::uint32_t atom : vertex_atoms(mesh)) velocities.push_back(frame.velocities[beside.object.atom[atom]]);
  return velocities;
}

// Whole, with velocities.
std::vector<blender::MeshedObject> moving_objects(const BlenderCommand& command, const Molecule& molecule,
                                                  const RunFrame& frame, double tolerance) {
  std::vector<TriangleMesh> meshes = mesh_objects(molecule.objects, tolerance, !molecule.beside.empty());
  std::vector<blender::MeshedObject> objects;
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    const SurfaceObject& object = molecule.objects[n];
    std::vector<glm::dvec3> velocities = velocities_of(object, meshes[n], frame);
    objects.push_back({object, std::move(meshes[n]), blender::atom_attributes(molecule.structure, object.atom),
                       std::move(velocities), command.figure.thickens});
  }
  return objects;
}

// Of all objects what --attributes asks for. Returns what had to be left out.
std::string add_numbers(const BlenderCommand& command, blender::SurfaceNumbers wanted, const Structure& structure,
                        std::vector<blender::MeshedObject>& objects) {
  const std::vector<double> buried =
      buried_by_chains(command.molecule, structure, wanted.names, command.attributes == "all");
  std::string left_out;
  for (blender::MeshedObject& object : objects) {
    const std::string note = blender::add_surface_numbers(object, wanted, buried);
    if (left_out.empty()) left_out = note;
  }
  return left_out;
}

// A file for each frame of the chunk; the manifest for all of the run, the same from every chunk.
void run_sequence(const BlenderCommand& asked) {
  BlenderCommand command = asked;
  const blender::SurfaceNumbers numbers = blender::parse_surface_numbers(command.attributes);
  std::once_flag told;
  ExportRun run(command, true);
  const blender::SequenceManifest manifest = manifest_of(command, run);
  const std::string name = run_name(manifest);
  const std::filesystem::path folder = command.output.path;
  const std::filesystem::path written = write_manifest(folder, command.output.existing(), manifest);
  run.run(kMeshBytesPerAtom, [&](MoleculeBuilder& builder, const RunFrame& frame) -> FinishFrame {
    Molecule molecule = builder.build(frame.structure);
    const blender::CutFile cut = cut_file(command, manifest.shot(frame.place).camera, molecule.objects);
    std::vector<blender::MeshedObject> objects =
        cut.planes.empty() ? moving_objects(command, molecule, frame, manifest.tolerance)
                           : cut_objects(command, molecule, cut, manifest.tolerance, !molecule.beside.empty());
    std::optional<ShapeObject> beside;
    add_beside(molecule, manifest.tolerance, beside, objects);
    if (beside && cut.planes.empty()) objects.back().velocities = velocities_of(*beside, objects.back().mesh, frame);
    const std::string left_out = add_numbers(command, numbers, molecule.structure, objects);
    if (!left_out.empty()) std::call_once(told, [&] { say(command.molecule, left_out); });
    blender::Provenance provenance = manifest.provenance;
    provenance.device = molecule.device;
    provenance.colors = key_of(molecule);
    const std::string path = (folder / blender::frame_file(frame.number)).string();
    write_objects(path, command.output.existing(), objects, manifest.shot(frame.place), provenance,
                  blender::PlaceInRun{name, frame.number, frame.place + 1}, cut);
    return [path] { return MadeFrame{{path}}; };
  });
  std::cout << escaped(written.string()) << "\n";
}

std::vector<blender::MeshedObject> whole_objects(const BlenderCommand& command, const Molecule& molecule,
                                                 double tolerance, bool may_be_empty) {
  std::vector<TriangleMesh> meshes = mesh_and_tell(command.molecule, molecule.objects, tolerance, may_be_empty);
  std::vector<blender::MeshedObject> objects;
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    const SurfaceObject& object = molecule.objects[n];
    objects.push_back({object,
                       std::move(meshes[n]),
                       blender::atom_attributes(molecule.structure, object.atom),
                       {},
                       command.figure.thickens});
  }
  return objects;
}

// Before anything is computed.
void check(const BlenderCommand& command) {
  check_caps_of_map(command, "a .mns file has no values of the map on caps");
  check_export(command, " in Blender");
}

void run(const BlenderCommand& command) {
  check(command);
  if (command.frames.asked()) return run_sequence(command);
  const blender::SurfaceNumbers numbers = blender::parse_surface_numbers(command.attributes);
  AimedFigure aimed = aimed_figure(command);
  Figure& figure = aimed.figure;
  Molecule& molecule = figure.molecule;
  molecule.beside = std::move(figure.beside.shapes);
  const std::vector<Ball> balls = shown_balls(molecule);
  const Camera camera = aimed.camera(command, command.picture);
  const double tolerance = tolerance_of(command.mesh, command.picture.size(), camera, balls);
  const blender::CutFile cut = cut_file(command, camera, molecule.objects);
  const bool alone = molecule.beside.empty() && figure.beside.objects.empty();
  std::vector<blender::MeshedObject> objects;
  if (!command.figure.hides_surface)
    objects = cut.planes.empty() ? whole_objects(command, molecule, tolerance, !alone)
                                 : cut_objects(command, molecule, cut, tolerance, !alone);
  std::optional<ShapeObject> beside;
  add_beside(molecule, tolerance, beside, objects);
  std::vector<ShapeObject> more;
  add_more(command, figure, camera, tolerance, more, objects);
  if (std::ranges::all_of(objects, [](const blender::MeshedObject& each) { return each.mesh.triangles.empty(); }))
    throw RequestError("the surface is not shown, and there is nothing beside it");
  const std::string left_out = add_numbers(command, numbers, molecule.structure, objects);
  if (!left_out.empty()) say(command.molecule, left_out);
  const blender::Provenance provenance{file_name(molecule.structure.file), molecule.structure.radii_set,
                                       molecule.device, key_of(molecule)};
  write_objects(command.output.path, command.output.existing(), objects,
                blender::Shot{camera, command.picture.width, command.picture.height}, provenance, {}, cut);
  std::cout << escaped(command.output.path) << "\n";
}

void add_attributes(CLI::App& command, std::string& attributes) {
  std::vector<std::string> words{"usual", "all", "none"};
  for (const VertexNumberKind& kind : vertex_number_kinds()) words.emplace_back(kind.name);
  PropertyOptions(command)
      .add("mesh.attributes", attributes)
      ->description(
          "Numbers of the surface, separated by commas: usual (exact curvature, areas of atoms and patches), "
          "all, none, or names as of export mesh [usual]")
      ->check(proposes(words));
}

}  // namespace

void add_export_blender(CLI::App& command) {
  describe(
      command, "Write a file for Blender: closed mesh, analytic patches, atoms, camera (add-on: meniscus_import)",
      "  meniscus export blender 1tii.pdb -o 1tii.mns\n"
      "  meniscus export blender 1tii.pdb -o 1tii.mns --camera camera.json --tolerance-pixels 0.25 "
      "--size 1920x1080\n"
      "  meniscus export blender adk.psf --trajectory adk.dcd --frames all -o adk   a file a frame, and a manifest");
  auto state = std::make_shared<BlenderCommand>();
  add_shown_options(command, *state);
  add_mesh_options(command, state->mesh);
  add_attributes(command, state->attributes);
  add_run_options(command, *state);
  PropertyOptions(command).add("frames.fps", state->fps)->description("Frames per second of a run [24]");
  add_scene_options(command, &state->save_scene);
  add_output_options(command, state->output, ".mns file to write; of a run, the folder");
  command.callback([state, &command] { run_export(command, *state, [&] { run(*state); }); });
}

}  // namespace meniscus
