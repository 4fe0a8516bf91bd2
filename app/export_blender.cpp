// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export blender`: mesh, analytic patches, atoms and camera as one .mns file.
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/blender_attributes.h"
#include "app/commands.h"
#include "app/mesh_options.h"
#include "core/base/text.h"
#include "core/surface/combine.h"
#include "exporters/blender/surface_file.h"

namespace meniscus {
namespace {

struct BlenderCommand {
  MoleculeOptions molecule;
  MeshCommandOptions mesh;
  PictureOptions picture;
  OutputOptions output;
};

void run(const BlenderCommand& command) {
  const Molecule molecule = load_molecule(command.molecule);
  const std::vector<Ball> balls = placed_balls(molecule.objects);
  const Camera camera = picture_camera(command.picture, balls);
  const double tolerance = tolerance_of(command.mesh, command.picture, camera, balls);
  std::vector<TriangleMesh> meshes = meshes_of(command.molecule, molecule.objects, tolerance);
  std::vector<blender::MeshedObject> objects;
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    const SurfaceObject& object = molecule.objects[n];
    objects.push_back({object, std::move(meshes[n]), blender_attributes(molecule.structure, object.atom)});
  }
  const blender::Provenance provenance{std::filesystem::path(molecule.structure.file).filename().string(),
                                       molecule.structure.radii_set, molecule.device, colors_json(molecule)};
  write_objects(command.output.path, command.output.existing(), objects,
                blender::Shot{camera, command.picture.width, command.picture.height}, provenance);
  std::cout << escaped(command.output.path) << "\n";
}

}  // namespace

void add_export_blender(CLI::App& command) {
  describe(command, "Write a file for Blender: closed mesh, analytic patches, atoms, camera (add-on: meniscus_import)",
           "  meniscus export blender 1tii.pdb -o 1tii.mns\n"
           "  meniscus export blender 1tii.pdb -o 1tii.mns --camera camera.json --tolerance-pixels 0.25 "
           "--size 1920x1080");
  auto state = std::make_shared<BlenderCommand>();
  add_molecule_options(command, state->molecule);
  add_mesh_options(command, state->mesh);
  add_picture_options(command, state->picture);
  add_output_options(command, state->output, ".mns file to write");
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
