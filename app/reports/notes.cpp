// SPDX-License-Identifier: BSD-3-Clause
// Prints notes for people, one line per fact, none if quiet; and assemblies, frames and boxes of files.
#include "app/reports/notes.h"

#include <iostream>

#include <CLI/Error.hpp>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "app/process/system_process.h"
namespace meniscus {
namespace {

/// Returns true if a preset has this rule for molecules of all kinds.
bool is_rule_of_preset(const std::string& atoms) {
  return std::ranges::any_of(kPresets, [&](const Preset& preset) {
    return std::ranges::any_of(preset.settings, [&](const auto& one) { return one.text.starts_with(atoms + "="); });
  });
}

void log_structure(const SceneCommand& command, const Structure& structure) {
  log_line(command, fmt::format("{}: {}", structure.file, structure.report.sentence()));
  for (const AddedFile& added : structure.added) log_line(command, added.sentence());
  *command.added = structure.added;
  if (command.scene.molecule.color.uses(ColorScheme::By::plddt))
    log_line(command, fmt::format("{}: pLDDT is that of {}", structure.file, source_of_confidence(structure)));
  log_warnings(command, structure);
  for (const std::string& rule : rules_without_atoms(structure, command.scene.molecule.color))
    if (!is_rule_of_preset(rule))
      log_line(command,
               fmt::format("warning: {}: {} selects none of the atoms used; chains and names are case-sensitive",
                           structure.file, in_quotes(rule)));
}

}  // namespace

void log_line(const SceneCommand& command, const std::string& line) {
  if (!command.reporting.quiet) std::cerr << "meniscus: " << escaped(line) << std::endl;
}

void log_warnings(const SceneCommand& command, const Structure& structure) {
  if (command.reporting.warnings == WarningDetail::none) return;
  for (const Warning& warning : structure.report.warnings) {
    log_line(command, "warning: " + structure.file + ": " + warning.text);
    if (command.reporting.warnings != WarningDetail::full) continue;
    for (const std::string& detail : warning.details) log_line(command, "  " + detail);
  }
}

void warn_beyond_map(const SceneCommand& command, double share, std::string_view whose) {
  if (share <= 0.0 || command.reporting.warnings == WarningDetail::none) return;
  log_line(command, fmt::format("warning: {}: {:.3g} % of {} lies outside of this map and has the colour of missing "
                                "numbers (--missing-color); compute a map that holds all of it",
                                command.scene.molecule.volume_file, std::clamp(100.0 * share, 0.001, 99.9), whose));
}

ProgressSink progress_on_stderr(const SceneCommand& command) {
  if (command.reporting.quiet) return {};
  auto text = std::make_shared<ProgressText>(system_process::is_terminal(stderr),
                                             [](std::string_view part) { std::cerr << part << std::flush; });
  return [text](const ProgressReport& report) { text->report(report); };
}

Structure read_and_log(const SceneCommand& command) {
  if (command.scene.molecule.reading.assembly == "list") {
    MoleculeRequest listing = command.scene.molecule;
    listing.reading.assembly.clear();
    listing.reading.list_assemblies = true;
    listing.division.instances = InstanceMode::none;
    print_assemblies(read_molecule(listing));
    throw CLI::Success();
  }
  Structure structure = read_molecule(command.scene.molecule);
  log_structure(command, structure);
  return structure;
}

void log_run(const SceneCommand& command, const FrameRun& frames) {
  log_structure(command, frames.structure());
  const Trajectory& trajectory = frames.trajectory();
  log_line(command,
           fmt::format("{}: {}, {} {}; this run has {}{}", trajectory.path(), trajectory.format(),
                       with_thousands(trajectory.frame_count()), trajectory.frame_count() == 1 ? "frame" : "frames",
                       with_thousands(frames.numbers().size()),
                       frames.chunk().size() < frames.numbers().size()
                           ? fmt::format(", {} of them made here", frames.chunk().size())
                           : ""));
  for (const Warning& warning : trajectory.warnings())
    if (command.reporting.warnings != WarningDetail::none)
      log_line(command, fmt::format("warning: {}: {}", trajectory.path(), warning.text));
  if (!trajectory.cut_short().empty())
    log_line(command, fmt::format("warning: {}: {}", trajectory.path(), trajectory.cut_short()));
  if (command.scene.molecule.color.by == ColorScheme::By::component && frames.numbers().size() > 1)
    log_line(command, "warning: components are numbered again in each frame, so a colour may move to another part");
}

void log_surface(const SceneCommand& command, const Molecule& molecule) {
  warn_beyond_map(command, molecule.beyond_map, "the surface");
  if (command.reporting.verbose)
    log_line(command, fmt::format("surface on {} in {:.1f} ms", molecule.device, total_ms(molecule.stages)));
  log_grown_radii(command, change_of_radii(molecule.objects).grown_by);
}

void log_grown_radii(const SceneCommand& command, double grown_by) {
  if (grown_by > 0.0)
    log_line(command, fmt::format("spheres meet in one point; radii were increased by up to {:.2g} Å to separate them",
                                  grown_by));
}

Molecule build_and_log(const SceneCommand& command, Structure structure) {
  Molecule molecule = MoleculeBuilder(command.scene.molecule).build(std::move(structure));
  log_surface(command, molecule);
  return molecule;
}

Molecule load_molecule(const SceneCommand& command) { return build_and_log(command, read_and_log(command)); }

void log_times(const SceneCommand& command, const std::string& device, std::span<const StageTime> stages) {
  if (!command.reporting.verbose) return;
  std::string times;
  for (const StageTime& stage : stages)
    times += fmt::format("{}{} {:.1f} ms", times.empty() ? "" : ", ", stage.name, stage.milliseconds);
  log_line(command, fmt::format("picture on {}: {}", device, times));
}

void warn_if_unseen(const SceneCommand& command, const std::optional<Camera>& given, const Structure& structure) {
  const ViewRequest& picture = command.scene.picture;
  if (given && !picture.zoom_to && picture.turns.empty() &&
      sees_nothing(*given, picture.aspect(), structure, command.scene.molecule.surface.probe_radius))
    log_line(command, fmt::format("warning: {}: this camera does not see the molecule: all atoms are behind the camera "
                                  "or outside the picture; --zoom-to EXPR turns to them",
                                  picture.camera_file));
}

void print_assemblies(const Structure& structure) {
  if (structure.assemblies.empty()) {
    fmt::print(std::cout, "assemblies    none described\n");
    return;
  }
  fmt::print(std::cout, "\n{:<14} {:>10}  {:<24} {}\n", "assembly", "copies", "chains", "");
  for (const Assembly& assembly : structure.assemblies) {
    for (const AssemblyPart& part : assembly.parts) {
      std::string chains = part.chains.empty() ? "all" : escaped(fmt::format("{}", fmt::join(part.chains, ",")));
      if (chains.size() > 24) chains = fmt::format("{}... ({})", chains.substr(0, 14), part.chains.size());
      fmt::print(std::cout, "{:<14} {:>10}  {:<24} {}\n", escaped(assembly.id), with_thousands(part.motions.size()),
                 chains, escaped(assembly.description));
    }
  }
}

namespace {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(glm::dot(a, b) / (glm::length(a) * glm::length(b))) * 180.0 / std::numbers::pi;
}

std::string box_text(const Frame& frame) {
  if (!frame.cell) return "none in the first frame";
  const auto& [a, b, c] = std::array{(*frame.cell)[0], (*frame.cell)[1], (*frame.cell)[2]};
  return fmt::format("{:.3f} {:.3f} {:.3f} Å, {:.2f} {:.2f} {:.2f} degrees (first frame)", glm::length(a),
                     glm::length(b), glm::length(c), degrees_between(b, c), degrees_between(a, c),
                     degrees_between(a, b));
}

/// Reads a frame. A frame that cannot be read is reported, and returned without contents.
Frame read_or_warn(Trajectory& trajectory, std::uint64_t number) {
  Frame frame;
  try {
    trajectory.read(number, frame);
  } catch (const InputError& error) {
    fmt::print(std::cerr, "meniscus: warning: {}\n", escaped(error.what()));
  }
  return frame;
}

}  // namespace

void print_trajectory(Trajectory& trajectory) {
  const Frame first = read_or_warn(trajectory, 0);
  const Frame last = read_or_warn(trajectory, trajectory.frame_count() - 1);
  fmt::print(std::cout, "trajectory    {} ({})\n", escaped(trajectory.path()), trajectory.format());
  fmt::print(std::cout, "atoms         {} in each frame\n", with_thousands(trajectory.atom_count()));
  fmt::print(std::cout, "frames        {} (0 to {})\n", with_thousands(trajectory.frame_count()),
             trajectory.frame_count() - 1);
  if (first.time && last.time) {
    fmt::print(std::cout, "times         {:.3f} to {:.3f} ps\n", *first.time, *last.time);
  } else {
    fmt::print(std::cout, "times         none\n");
  }
  if (first.step && last.step) fmt::print(std::cout, "steps         {} to {}\n", *first.step, *last.step);
  fmt::print(std::cout, "box           {}\n", box_text(first));
  if (!trajectory.cut_short().empty()) fmt::print(std::cout, "cut short     {}\n", trajectory.cut_short());
  for (const Warning& warning : trajectory.warnings())
    fmt::print(std::cerr, "meniscus: warning: {}: {}\n", trajectory.path(), warning.text);
}

}  // namespace meniscus
