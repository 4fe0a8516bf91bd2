// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export atoms`: writes the atoms of a surface, and their positions in each frame, as arrays.
#include <iostream>

#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/queries/copies.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "exporters/blender/mns_file.h"
#include "exporters/blender/sequence_manifest.h"

namespace meniscus {
namespace {

// Returns the positions of the atoms of merged() objects in another frame.
std::vector<glm::dvec3> placed_atoms(std::span<const SurfaceObject> objects, const Structure& structure) {
  std::vector<glm::dvec3> positions;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const std::uint32_t atom : object.atom) positions.push_back(copy(structure.atoms[atom].position));
  return positions;
}

// Returns the molecule of the first frame, which has the radii and colours of the run.
Molecule first_molecule(const SceneCommand& command, const FrameRun* run) {
  if (!run) return load_molecule(command);
  log_run(command, *run);
  return MoleculeBuilder(command.scene.molecule).build(run->structure());
}

void export_atoms(const SceneCommand& requested) {
  SceneCommand command = requested;
  if (command.scene.molecule.color.by == ColorScheme::By::volume)
    throw UsageError("--color-map-file colours points of a surface, not atoms; leave it out");
  if (command.scene.molecule.color.by == ColorScheme::By::lipophilicity)
    throw UsageError("--color lipophilicity colours points of a surface, not atoms; choose another --color");
  if (command.scene.molecule.division.instances == InstanceMode::separate)
    throw UsageError(
        "--instances separate: a file of atoms has one surface, so copies cannot be separate; leave it out");
  std::unique_ptr<FrameRun> run;
  if (command.scene.frames.is_requested()) {
    freeze_selections(command.scene);
    run = std::make_unique<FrameRun>(command.scene.molecule, command.scene.frames);
    if (run->atoms_change())
      throw UsageError(
          "export atoms: the file has the same atoms in all frames, but --select chooses others in each; add "
          "--select-once to keep those of the first");
  }
  Molecule molecule = first_molecule(command, run.get());
  blender::AtomFrames frames;
  if (run) {
    frames.numbers = run->chunk();
    frames.next = [&] {
      const RunFrame frame = run->next().value();
      return blender::AtomFrame{placed_atoms(molecule.objects, frame.structure), frame.time};
    };
  }
  const ColorKey key = key_of(molecule);
  const SurfaceObject whole = merged(molecule.objects);
  blender::write_atoms(command.scene.output, command.existing(), whole,
                       blender::atom_attributes(molecule.structure, whole.atom),
                       {std::filesystem::path(molecule.structure.file).filename().string(),
                        molecule.structure.radii_set, molecule.device, key},
                       frames);
  std::cout << escaped(command.scene.output) << "\n";
}

void declare_atoms(CLI::App& command) {
  describe(
      command,
      "  meniscus export atoms 1tii.pdb -o 1tii.atoms\n"
      "  meniscus export atoms adk.psf --trajectory adk.dcd --frames all --select protein -o adk.atoms",
      "For programs that compute surfaces themselves with libmeniscus, such as the panel of the Blender add-on. The "
      "file\n"
      "is described in exporters/blender/FORMAT.md; radii and colours are those of the first frame of a run.");
  auto declared = std::make_shared<DeclaredCommand<>>(command, run_properties().with({"Colour", "output.file"}));
  declared->options.describe_output("File to write");
  command.callback([declared] {
    declared->options.take();
    export_atoms(declared->state);
  });
}

const ExportCommand kAtoms("atoms", "Write the atoms of a surface with radii, colours and frames, as arrays",
                           declare_atoms);

}  // namespace
}  // namespace meniscus
