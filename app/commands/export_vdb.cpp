// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export vdb`: writes the exact signed distance from the surface as a level set of OpenVDB.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/options/named_files.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/scene/frame_run.h"
#include "core/scene/surface_computer.h"
#include "exporters/vdb/vdb_file.h"

namespace meniscus {
namespace {

// The approximate memory of a frame: the voxels of the band and their file.
constexpr std::uint64_t kBandBytesPerAtom = 50'000;

struct VdbCommand : SceneCommand {
  double voxel = 0.5;  ///< Å
  int band = 3;        ///< voxels
};

std::string about_level_set(const VdbCommand& command) {
  const Scene& scene = command.scene;
  return fmt::format("Meniscus {}: 1 Angstrom is {:g}; {} surface, voxels of {:g} Angstrom", MENISCUS_VERSION,
                     scene.mesh.scale, kind_word(scene.molecule.surface.kind), command.voxel);
}

void log_report(const VdbCommand& command, const DistanceBand& band) {
  log_line(command,
           fmt::format("{} blocks of 8 x 8 x 8 voxels of {:g} Å; distances to {:g} Å; 1 Å is {:g} in the file",
                       with_thousands(band.blocks.size()), command.voxel, band.reach, command.scene.mesh.scale));
}

void export_to_vdb(const VdbCommand& requested) {
  VdbCommand command = requested;
  const Scene& scene = command.scene;
  const auto numbered = NumberedPath::parse(scene.output);
  if (scene.frames.is_requested() && !numbered)
    throw UsageError("-o {}: each frame needs a file of its own; put # where its number goes, as in {}",
                     in_quotes(scene.output), in_quotes(numbered_name(scene.output)));
  freeze_selections(command.scene);
  NumberRun run(command);
  const auto make_worker = [&](const std::shared_ptr<MoleculeBuilder>& builder) -> NumberRun::Worker {
    return [&, builder](NumberedStructure numbered_structure) -> FinishFrame {
      const Molecule molecule = builder->build(std::move(numbered_structure.structure));
      if (molecule.objects.size() > 1 || molecule.objects.front().copies.size() > 1)
        throw RequestError("a level set is of one surface in one place; leave --instances out");
      const DistanceBand band = distance_band(molecule.surface(), command.voxel, command.band);
      if (!run.is_run()) log_report(command, band);
      const std::string path = run.is_run() ? numbered->at(numbered_structure.number) : scene.output;
      OutputFile file(path_of_text(path), command.existing());
      write_vdb(file, band, {scene.mesh.scale, about_level_set(command)});
      file.commit();
      return [path] {
        std::cout << escaped(path) << "\n";
        return MadeFrame{{path}};
      };
    };
  };
  run.make(kBandBytesPerAtom, make_worker, [] {});
}

void declare_vdb(CLI::App& command) {
  describe(command,
           "  meniscus export vdb 1tii.pdb -o 1tii.vdb\n"
           "  meniscus export vdb 1tii.pdb -o 1tii.vdb --voxel 0.25 --band 8\n"
           "  meniscus export vdb adk.psf adk.dcd --frames 0-90 -o adk_###.vdb   one file per frame",
           "The grid `surface` has the Euclidean distance from the exact surface at each voxel of a band around it, "
           "negative in\nthe solid: a level set, as Houdini, Blender and OpenVDB's own tools take it. Voxel i, j, k is "
           "at i, j, k times --voxel.");
  auto declared = std::make_shared<DeclaredCommand<VdbCommand>>(
      command, run_properties().with({"mesh.unit", "mesh.scale", "output.file", "scene.save"}));
  declared->options.describe_output("File to write; for frames with # for the number");
  PropertyOptions options(command);
  options.add("distances.voxel", declared->state.voxel);
  options.add("distances.band", declared->state.band);
  command.callback([declared] {
    declared->options.take();
    run_and_save_scene(declared->state, [&] { export_to_vdb(declared->state); });
  });
}

const ExportCommand kVdb("vdb", "Write the exact signed distance from the surface as an OpenVDB level set",
                         declare_vdb);

}  // namespace
}  // namespace meniscus
