// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export ply`: the closed mesh as a binary PLY file.
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>

#include "app/commands/commands.h"
#include "app/options/scene_file.h"
#include "app/options/mesh_options.h"
#include "core/base/text.h"
#include "core/queries/combine.h"
#include "app/reports/notes.h"
#include "app/options/figure_options.h"
#include "app/options/molecule_options.h"
#include "app/options/picture_options.h"
#include "app/options/representation_options.h"
#include "exporters/mesh/ply.h"
#include "exporters/mesh/shape_mesh.h"

namespace meniscus {
namespace {

struct PlyCommand {
  MoleculeOptions molecule;
  MeshRequest mesh;
  ViewRequest picture;
  OutputOptions output;
  std::string save_scene;  // path; empty: it is not saved
};

// One row for each atom of the surface.
std::vector<AtomScalar> scalars_of(const std::vector<Atom>& shown, const std::vector<std::uint32_t>& atoms) {
  AtomScalar b_factor{"b_factor", {}}, number{"atomic_number", {}}, residue{"res_id", {}}, radius{"vdw_radii", {}},
      place{"atom_index", {}};
  for (const std::uint32_t index : atoms) {
    const Atom& atom = shown[index];
    b_factor.values.push_back(std::isfinite(atom.b_factor) ? atom.b_factor : 0.0f);
    number.values.push_back(atom.element);
    residue.values.push_back(static_cast<float>(atom.residue_number));
    radius.values.push_back(static_cast<float>(atom.radius));
    place.values.push_back(static_cast<float>(index));
  }
  return {b_factor, number, residue, radius, place};
}

void run(const PlyCommand& command) {
  const std::optional<Camera> given = given_camera(command.picture);
  auto [molecule, aim] = load_aimed_molecule(command.molecule, command.picture, given);
  const std::vector<Ball> balls = shown_balls(molecule);
  const Camera camera = aim.camera(command.picture, given, molecule.objects);
  ShapeObject whole{merged(std::move(molecule.objects)), {}};
  const double tolerance = tolerance_of(command.mesh, command.picture.size(), camera, balls);
  whole.mesh = std::move(mesh_and_tell(command.molecule, {&whole.object, 1}, tolerance).front());
  const std::vector<Atom> atoms = shown_atoms(molecule.structure);
  if (!molecule.beside.empty())
    whole = joined(whole.object, std::move(whole.mesh), shape_object(atoms, molecule.beside, tolerance));
  write_ply(command.output.path, command.output.existing(), whole.mesh, whole.object.coloring,
            scalars_of(atoms, whole.object.atom));
  std::cout << escaped(command.output.path) << "\n";
}

}  // namespace

void add_export_ply(CLI::App& command) {
  describe(command, "Write a closed triangle mesh as binary PLY",
           "  meniscus export ply 1tii.pdb -o 1tii.ply\n"
           "  meniscus export ply 1tii.pdb -o fine.ply --tolerance 0.002 --color chain");
  auto state = std::make_shared<PlyCommand>();
  add_molecule_options(command, state->molecule);
  add_representation_options(command, state->molecule.representations);
  add_interface_option(command, state->molecule);
  add_mesh_options(command, state->mesh);
  add_picture_options(command, state->picture);
  add_scene_options(command, &state->save_scene);
  add_output_options(command, state->output, "PLY file to write");
  command.callback([state, &command] {
    take_interface(command, state->molecule, state->picture);
    SceneOutput scene(command, state->save_scene, state->output.existing());
    run(*state);
    scene.commit();
  });
}

}  // namespace meniscus
