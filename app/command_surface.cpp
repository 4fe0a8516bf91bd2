// SPDX-License-Identifier: BSD-3-Clause
// `meniscus surface`: computes the complete surface and prints its numbers, as a table or as one JSON object.
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/molecule.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

/// Raised when a key changes its meaning or goes away; new keys do not raise it.
constexpr int kSchemaVersion = 1;

struct SurfaceCommand {
  MoleculeOptions molecule;
  bool json = false;
};

const char* kind_name(ComponentKind kind) { return kind == ComponentKind::outer ? "outer" : "cavity"; }

nlohmann::ordered_json to_json(const Molecule& molecule) {
  using Json = nlohmann::ordered_json;
  const Structure& structure = molecule.structure;
  const Surface& surface = molecule.surface();
  const SurfaceCounts counts = surface.counts();
  Json excluded = Json::object();
  for (const auto& [reason, count] : structure.report.excluded) excluded[reason] = count;
  Json components = Json::array();
  for (const Component& component : surface.components) {
    components.push_back({{"kind", kind_name(component.kind)},
                          {"area", component.area},
                          {"volume", component.volume},
                          {"euler", component.euler}});
  }
  Json stages = Json::array();
  for (const StageTime& stage : molecule.stages) stages.push_back({{"name", stage.name}, {"ms", stage.milliseconds}});
  return {{"schema_version", kSchemaVersion},
          {"atoms", {{"read", structure.report.read}, {"excluded", excluded}, {"used", structure.report.used}}},
          {"probe_radius", surface.probe_radius},
          {"radii_set", structure.radii_set},
          {"counts",
           {{"convex", counts.convex},
            {"toroidal", counts.toroidal},
            {"concave", counts.concave},
            {"free_edges", counts.free_edges},
            {"spindle", counts.spindle},
            {"fixed_probes", counts.fixed_probes},
            {"arcs", counts.arcs}}},
          {"area", surface.area},
          {"volume", surface.volume},
          {"components", components},
          {"certificate", {{"closed", surface.certificate.closed}, {"open_atoms", surface.certificate.open_atoms}}},
          {"device", molecule.device},
          {"stages", stages}};
}

void print_table(const Molecule& molecule) {
  const Structure& structure = molecule.structure;
  const Surface& surface = molecule.surface();
  const SurfaceCounts counts = surface.counts();
  const auto n = [](std::size_t count) { return with_thousands(count); };
  fmt::print(std::cout, "molecule      {} ({})\n", escaped(structure.file), structure.format);
  fmt::print(std::cout, "atoms         {}\n", structure.report.sentence());
  fmt::print(std::cout, "probe, radii  {} Å, {}\n", surface.probe_radius,
             structure.radii_set == "file" ? "radii of the file" : structure.radii_set);
  fmt::print(std::cout, "patches       {} convex, {} toroidal ({} spindle, {} free), {} concave\n", n(counts.convex),
             n(counts.toroidal), n(counts.spindle), n(counts.free_edges), n(counts.concave));
  fmt::print(std::cout, "reduced       {} fixed probes, {} arcs\n", n(counts.fixed_probes), n(counts.arcs));
  fmt::print(std::cout, "area          {:.3f} Å²\nvolume        {:.3f} Å³\n", surface.area, surface.volume);
  fmt::print(std::cout, "closed        {}\n", surface.certificate.closed ? "yes" : "no");
  fmt::print(std::cout, "device        {}\n", molecule.device);
  for (const StageTime& stage : molecule.stages)
    fmt::print(std::cout, "time          {:>9.2f} ms  {}\n", stage.milliseconds, stage.name);
  fmt::print(std::cout, "\n{:>9}  {:<7} {:>14} {:>16} {:>6}\n", "component", "kind", "area Å²", "volume Å³", "Euler");
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    const Component& component = surface.components[c];
    fmt::print(std::cout, "{:>9}  {:<7} {:>13.3f} {:>15.3f} {:>6}\n", c, kind_name(component.kind), component.area,
               component.volume, component.euler);
  }
}

void run(const SurfaceCommand& command) {
  const Molecule molecule = load_molecule(command.molecule);
  if (command.json) {
    std::cout << to_json(molecule).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  } else {
    print_table(molecule);
  }
}

}  // namespace

void add_surface(CLI::App& command) {
  describe(
      command, "Compute the surface; print area, volume, components and counts",
      "  meniscus surface 1tii.pdb                     a table\n"
      "  meniscus surface 1tii.pdb --json > 1tii.json  one JSON object\n"
      "  meniscus surface balls.xyzr --probe 0         van der Waals surface, radii of the file",
      "Used are the polymers and ligands of the first model, of each residue the most occupied conformer; water and\n"
      "free ions are left out. What was read, left out and used is always said. Radii are Bondi's (`meniscus info`\n"
      "lists them), or the file's own (XYZR). The surface is complete, cavities too, and closed; areas and volumes\n"
      "are exact, in closed form. A cavity's volume is negative: it is missing from the solid.");
  auto state = std::make_shared<SurfaceCommand>();
  add_atom_options(command, state->molecule);
  add_surface_options(command, state->molecule);
  command.add_flag("--json", state->json, "Print one JSON object instead of a table");
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
