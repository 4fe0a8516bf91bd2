// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export povray`: a folder with a POV-Ray scene of the analytic patches.
#include <iostream>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/molecule.h"
#include "app/picture_options.h"
#include "core/base/text.h"
#include "core/surface/combine.h"
#include "exporters/povray/scene.h"

namespace meniscus {
namespace {

struct PovrayCommand {
  MoleculeOptions molecule;
  PictureOptions picture;
  OutputOptions output;
  povray::Material material = povray::Material::opaque;
};

void run(const PovrayCommand& command) {
  const Molecule molecule = load_molecule(command.molecule);
  povray::SceneOptions options;
  options.width = command.picture.width;
  options.height = command.picture.height;
  options.material = command.material;
  options.existing = command.output.existing();
  options.colors = colors_json(molecule);
  const Camera camera = picture_camera(command.picture, placed_balls(molecule.objects));
  const povray::SceneReport report = write_scene(molecule.objects, camera, options, command.output.path);
  say(command.molecule,
      fmt::format("{} primitives in {} files", with_thousands(report.object_count), report.files.size()));
  for (const std::string& note : report.notes) say(command.molecule, "note: " + note);
  std::cout << escaped(report.command) << "\n";
}

}  // namespace

void add_export_povray(CLI::App& command) {
  describe(command, "Write a POV-Ray scene of the analytic patches, no triangles; prints how to render it",
           "  meniscus export povray 1tii.pdb -o 1tii                 then: cd 1tii; povray surface.ini\n"
           "  meniscus export povray 1tii.pdb -o glass --material glass --size 1920x1080\n"
           "  meniscus export povray 1tii.pdb -o 1tii --camera camera.json --color chain --force");
  auto state = std::make_shared<PovrayCommand>();
  add_molecule_options(command, state->molecule);
  add_picture_options(command, state->picture);
  add_output_options(command, state->output, "Folder to write; made when missing");
  const std::map<std::string, povray::Material> words{{"opaque", povray::Material::opaque},
                                                      {"ghost", povray::Material::ghost},
                                                      {"glass", povray::Material::glass},
                                                      {"wax", povray::Material::wax}};
  command.add_option("--material", state->material, "Default material: opaque, ghost, glass, wax; the scene holds all")
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD");
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
