// SPDX-License-Identifier: BSD-3-Clause
// Atoms on their way to a view, and what a view says of itself.
#include "app/commands/view_picture.h"

#include <numeric>

#include <fmt/format.h>

#include "app/process/program_error.h"
#include "core/scene/hidden_atoms.h"
#include "app/reports/notes.h"
#include "app/options/scene_options.h"
#include "core/color/color_atoms.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

double milliseconds(const std::vector<StageTime>& times, std::initializer_list<std::string_view> names) {
  double sum = 0.0;
  for (const StageTime& time : times)
    if (std::ranges::find(names, time.name) != names.end()) sum += time.milliseconds;
  return sum;
}

}  // namespace

void check_view_options(const MoleculeRequest& request) {
  const auto refuse = [](const char* option) {
    throw UsageError(fmt::format("{} needs the complete surface; leave --extent away", option));
  };
  if (request.surface.cpu)
    throw UsageError(
        "--extent finds on GL what the view needs; leave --device cpu away, or --extent: the picture is the same");
  if (request.division.groups || request.division.components) refuse("--by");
  if (request.division.cavities != Cavities::keep) refuse("--cavities");
  if (request.division.instances != InstanceMode::none) refuse("--instances");
  if (request.color.by == ColorScheme::By::component) refuse("--color component");
  if (request.color.by == ColorScheme::By::buried || request.interface) refuse("--color buried");
  if (request.color.by == ColorScheme::By::volume) refuse("--color-map-file");
  if (request.surface.verify) refuse("--verify");
  if (request.surface.kind != SurfaceKind::ses) refuse("--surface sas or vdw");
}

ColoredAtoms colored_atoms(const MoleculeRequest& request, Structure molecule) {
  ColoredAtoms atoms;
  atoms.molecule.structure = std::move(molecule);
  atoms.molecule.color = color_of(request);
  const Structure& structure = atoms.molecule.structure;
  atoms.balls = balls_of(structure);
  std::vector<std::uint32_t> all(structure.atoms.size());
  std::iota(all.begin(), all.end(), 0u);
  atoms.coloring = color_object(structure, all, atoms.molecule.color, 0);
  if (request.show) atoms.coloring.hidden = hidden_atoms(*request.show, structure);
  return atoms;
}

void show(const ColoredAtoms& atoms, double probe_radius, Extent extent, ViewPipeline& view) {
  view.set_atoms(atoms.balls);
  view.set_coloring(atoms.coloring);
  view.set_surface(probe_radius, extent);
}

std::string stats_text(const ViewStats& n, const std::vector<StageTime>& times, glm::ivec2 picture_size) {
  const auto line = [](const char* name, double ms, const std::string& found) {
    return fmt::format("  {:<34} {:>9.2f} ms   {}\n", name, ms, found);
  };
  return line("1 visible atoms", milliseconds(times, {"upload", "visible atoms"}),
              fmt::format("{} of {} atoms can matter for a pixel", with_thousands(n.kept_atoms),
                          with_thousands(n.atoms))) +
         line("2 neighbours and potential arcs", milliseconds(times, {"neighbors", "circles", "doubtful circles"}),
              fmt::format("{} circles, {} decided again in double, {} on the host; {} arcs (RS edges)",
                          with_thousands(n.circles.pairs), with_thousands(n.circles.decided_in_double),
                          with_thousands(n.circles.decided_in_quadruple), with_thousands(n.arcs))) +
         line("3 visible and cutting RS faces", milliseconds(times, {"fixed probes"}),
              fmt::format("{} fixed probes", with_thousands(n.probes))) +
         line("4 primitives and singularities", milliseconds(times, {"primitives"}),
              fmt::format("{} patches", with_thousands(n.primitives))) +
         line("ray casting", milliseconds(times, {"tile lists", "ray cast"}),
              fmt::format("{}x{} pixels", picture_size.x, picture_size.y));
}

}  // namespace meniscus
