// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mesh`: the closed mesh as a file of any format; `meniscus export ply` is what it began as.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/commands/buried_attribute.h"
#include "app/commands/commands.h"
#include "app/options/mesh_options.h"
#include "app/options/molecule_options.h"
#include "app/options/numbered_path.h"
#include "app/options/picture_options.h"
#include "app/options/figure_options.h"
#include "app/options/scene_file.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "exporters/mesh_files/file_object.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

constexpr double kManyTriangles = 2e7;

struct MeshCommand {
  MoleculeOptions molecule;
  MeshFileOptions mesh;
  ViewRequest picture;
  OutputOptions output;
  std::string save_scene;  // path; empty: it is not saved
};

std::string scale_sentence(const MeshFormat& format, double scale) {
  if (format.word == "dms") return "lengths are Å";
  return fmt::format("1 Å is {:g} {}", scale, format.unit.empty() ? "in the file" : format.unit);
}

void warn_of_many(const MeshCommand& command, const Molecule& molecule, const MeshFineness& fineness) {
  double triangles = 0.0;
  for (const SurfaceObject& object : molecule.objects)
    triangles += static_cast<double>(object.copies.size()) * estimated_triangles(object.surface, fineness);
  if (triangles > kManyTriangles)
    say(command.molecule, fmt::format("warning: about {:.0f} million triangles; a larger --tolerance or a smaller "
                                      "--density makes fewer",
                                      triangles / 1e6));
}

void refuse_what_does_not_fit(const MeshFormat& format, const Molecule& molecule, const MeshFineness& fineness) {
  const bool even = fineness.even || fineness.density > 0.0;
  const bool hides = std::ranges::any_of(molecule.objects, [](const auto& o) { return o.coloring.hides_some(); });
  if (even && hides)
    throw RequestError(
        "triangles of an even mesh reach over borders of atoms, so it cannot end where --show does; leave "
        "--even and --density away, or --select what is wanted");
  if (!format.solid) return;
  const bool whole = std::ranges::all_of(molecule.objects, &SurfaceObject::whole);
  if (molecule.objects.size() > 1 || !whole || hides || !molecule.beside.empty())
    throw RequestError(
        fmt::format("{} holds one closed surface, all of it: leave --by, --cavities, --show and shapes "
                    "beside it away",
                    format.word));
}

void tell(const MeshCommand& command, const MeshFormat& format, const MeshFileMaker& maker,
          const MeshFineness& fineness) {
  const std::string how = fineness.density > 0.0  ? fmt::format("{:g} vertices per Å²", fineness.density)
                          : fineness.tolerance_at ? fmt::format("within {:g} pixels of the surface, {:.4g} Å or more",
                                                                command.mesh.mesh.tolerance_pixels, fineness.tolerance)
                                                  : fmt::format("within {:.4g} Å of the surface", fineness.tolerance);
  say(command.molecule, fmt::format("{} triangles {}; {}", with_thousands(maker.triangle_count()), how,
                                    scale_sentence(format, command.mesh.scale)));
  if (maker.joined_edges() + maker.flipped_edges() > 0)
    say(command.molecule,
        fmt::format("welded: {} edges shorter than {} Å, {}{} triangles without area",
                    with_thousands(maker.joined_edges()), kFileStep,
                    maker.fins() > 0 ? fmt::format("{} fins no thicker, ", with_thousands(maker.fins())) : "",
                    with_thousands(maker.flipped_edges())));
  if (maker.flat_triangles() > 0)
    say(command.molecule,
        fmt::format("warning: {} triangles have no area in thousandths of an Å and could not be welded; "
                    "another --tolerance may have none",
                    with_thousands(maker.flat_triangles())));
}

// Objects in files of their own, all or none of them.
void write_numbered(const MeshFormat& format, const NumberedPath& path, Existing existing, MeshFile whole) {
  std::vector<FileObject> objects = std::exchange(whole.objects, {});
  const std::filesystem::path folder = std::filesystem::path(path.at(1)).parent_path();
  OutputFolder files(folder.empty() ? "." : folder, existing);
  std::vector<std::string> names;
  for (FileObject& object : objects) {
    names.push_back(path.at(names.size() + 1));
    whole.objects.clear();
    whole.objects.push_back(std::move(object));
    format.write(files.file(std::filesystem::path(names.back()).filename().string()), whole);
  }
  files.commit();
  for (const std::string& name : names) std::cout << escaped(name) << "\n";
}

void run(const MeshCommand& command) {
  const MeshFormat& format = command.mesh.format_of(command.output.path);
  std::vector<std::string> names;
  if (format.numbers) names = parse_vertex_numbers(command.mesh.attributes);
  const std::optional<Camera> given = given_camera(command.picture);
  auto [molecule, aim] = load_aimed_molecule(command.molecule, command.picture, given);
  const std::vector<Ball> balls = shown_balls(molecule);
  const Camera camera = aim.camera(command.picture, given, molecule.objects);
  const MeshFineness fineness =
      fineness_of(command.mesh.mesh, command.mesh.even, command.mesh.density, command.picture.size(), camera, balls);
  refuse_what_does_not_fit(format, molecule, fineness);
  warn_of_many(command, molecule, fineness);
  const std::vector<Atom> atoms = shown_atoms(molecule.structure);
  const std::vector<double> buried =
      buried_by_chains(command.molecule, molecule.structure, names, command.mesh.attributes == "all");
  MeshFileMaker maker({fineness, names, command.mesh.scale, atoms, buried, format.solid},
                      about_line(kind_word(command.molecule.surface.kind), command.mesh.scale, fineness));
  for (SurfaceObject& object : molecule.objects) maker.add(std::exchange(object, {}));
  if (!molecule.beside.empty()) maker.add(shape_object(atoms, molecule.beside, fineness.tolerance));
  tell(command, format, maker, fineness);
  if (const auto numbered = NumberedPath::parse(command.output.path)) {
    write_numbered(format, *numbered, command.output.existing(), maker.take());
  } else {
    write_mesh_file(format, command.output.path, command.output.existing(), maker.take());
    std::cout << escaped(command.output.path) << "\n";
  }
}

// What both commands have before the options of their files.
std::shared_ptr<MeshCommand> declared(CLI::App& command) {
  auto state = std::make_shared<MeshCommand>();
  add_molecule_options(command, state->molecule);
  add_representation_options(command, state->molecule.representations);
  add_interface_option(command, state->molecule);
  return state;
}

void finish(CLI::App& command, const std::shared_ptr<MeshCommand>& state, const std::string& output) {
  add_picture_options(command, state->picture);
  add_scene_options(command, &state->save_scene);
  add_output_options(command, state->output, output);
}

}  // namespace

void add_export_mesh(CLI::App& command) {
  describe(command, "Write a closed triangle mesh: STL, 3MF, OBJ, OFF, GLB, VTP, TetGen, DMS or PLY",
           "  meniscus export mesh 1tii.pdb -o 1tii.glb --color chain --density 2\n"
           "  meniscus export mesh 1tii.pdb -o 1tii.3mf --even --tolerance 0.1\n"
           "  meniscus export mesh 1tii.pdb -o 1tii.vtp --attributes mean_curvature,hydrophobicity\n"
           "  meniscus export mesh 1tii.pdb -o part_#.stl --by component",
           "Each object of --by is one of its own in 3MF, OBJ and GLB; with a # in the name of the output it is a file "
           "of its\nown, in any format. Without --tolerance and --density: half a pixel of --camera, else 0.05 Å.");
  const std::shared_ptr<MeshCommand> state = declared(command);
  add_mesh_file_options(command, state->mesh);
  finish(command, state, "File to write; its ending names the format");
  command.callback([state, &command] {
    take_interface(command, state->molecule, state->picture);
    take_camera_for_tolerance(command, !state->picture.camera_file.empty(), state->mesh);
    SceneOutput scene(command, state->save_scene, state->output.existing());
    run(*state);
    scene.commit();
  });
}

void add_export_ply(CLI::App& command) {
  describe(command, "Write a closed triangle mesh as binary PLY: export mesh with a tolerance of 0.01 Å",
           "  meniscus export ply 1tii.pdb -o 1tii.ply\n"
           "  meniscus export ply 1tii.pdb -o fine.ply --tolerance 0.002 --color chain");
  const std::shared_ptr<MeshCommand> state = declared(command);
  state->mesh.mesh = MeshRequest{};
  state->mesh.format = "ply";
  add_mesh_options(command, state->mesh.mesh);
  finish(command, state, "PLY file to write");
  command.callback([state, &command] {
    take_interface(command, state->molecule, state->picture);
    SceneOutput scene(command, state->save_scene, state->output.existing());
    run(*state);
    scene.commit();
  });
}

}  // namespace meniscus
