// SPDX-License-Identifier: BSD-3-Clause
// Lines for people: one a fact, none if quiet.
#include "app/reports/notes.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "app/options/molecule_options.h"
#include "app/reports/assembly_table.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"

namespace meniscus {
namespace {

void tell_structure(const MoleculeOptions& options, const Structure& structure) {
  say(options, fmt::format("{}: {}", structure.file, structure.report.sentence()));
  say_warnings(options, structure);
  for (const std::string& rule : rules_without_atoms(structure, options.color))
    say(options, fmt::format("warning: {}: no atom used is meant by {}; chains and names are case-sensitive",
                             structure.file, in_quotes(rule)));
}

Molecule built_and_told(const MoleculeOptions& options, Structure structure) {
  Molecule molecule = MoleculeBuilder(options).build(std::move(structure));
  tell_beyond_map(options, molecule.beyond_map, "the surface");
  say(options, fmt::format("surface on {} in {:.1f} ms", molecule.device, total_ms(molecule.stages)));
  if (const double grown_by = change_of_radii(molecule.objects).grown_by; grown_by > 0)
    say(options,
        fmt::format("spheres that meet in one point were told apart by radii grown by up to {:.2g} Å", grown_by));
  return molecule;
}

}  // namespace

void say(const MoleculeOptions& options, const std::string& line) {
  if (!options.quiet) std::cerr << "meniscus: " << escaped(line) << std::endl;
}

void say_warnings(const MoleculeOptions& options, const Structure& structure) {
  if (options.warnings == WarningDetail::none) return;
  for (const Warning& warning : structure.report.warnings) {
    say(options, "warning: " + structure.file + ": " + warning.text);
    if (options.warnings != WarningDetail::full) continue;
    for (const std::string& detail : warning.details) say(options, "  " + detail);
  }
}

void tell_beyond_map(const MoleculeOptions& options, double share, std::string_view whose) {
  if (share <= 0.0 || options.warnings == WarningDetail::none) return;
  say(options, fmt::format("warning: {}: {:.3g} % of {} lies outside of this map and has the colour of missing "
                           "numbers (--missing-color); compute a map that holds all of it",
                           options.volume_file, std::clamp(100.0 * share, 0.001, 99.9), whose));
}

ProgressSink progress_on_stderr(const MoleculeOptions& options) {
  if (options.quiet) return {};
  auto text = std::make_shared<ProgressText>(::isatty(STDERR_FILENO) == 1,
                                             [](std::string_view part) { std::cerr << part << std::flush; });
  return [text](const ProgressReport& report) { text->report(report); };
}

Structure read_and_tell(const MoleculeOptions& options) {
  if (options.reading.assembly == "list") {
    MoleculeRequest listing = options;
    listing.reading.assembly.clear();
    listing.reading.list_assemblies = true;
    listing.division.instances = InstanceMode::none;
    print_assemblies(read_molecule(listing));
    throw CLI::Success();
  }
  Structure structure = read_molecule(options);
  tell_structure(options, structure);
  return structure;
}

void tell_run(const MoleculeOptions& options, const FrameRun& frames) {
  tell_structure(options, frames.structure());
  const Trajectory& trajectory = frames.trajectory();
  say(options, fmt::format("{}: {}, {} frames; this run has {}{}", trajectory.path(), trajectory.format(),
                           with_thousands(trajectory.frame_count()), with_thousands(frames.numbers().size()),
                           frames.chunk().size() < frames.numbers().size()
                               ? fmt::format(", of which {} are made here", frames.chunk().size())
                               : ""));
  for (const Warning& warning : trajectory.warnings())
    if (options.warnings != WarningDetail::none)
      say(options, fmt::format("warning: {}: {}", trajectory.path(), warning.text));
  if (!trajectory.cut_short().empty())
    say(options, fmt::format("warning: {}: {}", trajectory.path(), trajectory.cut_short()));
}

std::vector<TriangleMesh> mesh_and_tell(const MoleculeOptions& options, std::span<const SurfaceObject> objects,
                                        double tolerance, bool may_be_empty) {
  std::vector<TriangleMesh> meshes = mesh_objects(objects, tolerance, may_be_empty);
  say(options,
      fmt::format("{} triangles within {:.4g} Å of the surface", with_thousands(triangle_count(meshes)), tolerance));
  return meshes;
}

Molecule load_molecule(const MoleculeOptions& options) { return built_and_told(options, read_and_tell(options)); }

AimedMolecule load_aimed_molecule(const MoleculeOptions& options, const ViewRequest& picture,
                                  const std::optional<Camera>& given) {
  Structure structure = read_and_tell(options);
  ViewAim aim(picture, options.show, structure);
  if (given && !picture.zoom_to && picture.turns.empty() &&
      sees_nothing(*given, picture.aspect(), structure, options.surface.probe_radius))
    say(options, fmt::format("warning: {}: this camera sees nothing of the molecule: all atoms are behind it or beside "
                             "the picture; --zoom-to EXPR turns to them",
                             picture.camera_file));
  return {built_and_told(options, std::move(structure)), std::move(aim)};
}

}  // namespace meniscus
