// SPDX-License-Identifier: BSD-3-Clause
// Finds the patches of all objects, and formats them.
#include "app/reports/patch_report.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/reports/csv_tables.h"
#include "core/base/text.h"

namespace meniscus {

PatchReport patch_report(const Molecule& molecule, const Selection& selection, double least) {
  const std::vector<bool> selected = patch_atoms(selection, molecule.structure.atoms);
  PatchReport report{selection.text(), least, 0.0, 0, {}};
  for (const SurfaceObject& object : molecule.objects) {
    std::vector<bool> chosen;
    for (const std::uint32_t atom : object.atom) chosen.push_back(selected[atom]);
    for (AtomPatch& patch : atom_patches(object.surface, chosen)) {
      report.area += patch.area;
      ++report.count;
      if (patch.area < least) continue;
      for (std::uint32_t& atom : patch.atoms) atom = object.atom[atom];
      report.patches.push_back(std::move(patch));
    }
  }
  std::ranges::stable_sort(report.patches, std::greater<>(), &AtomPatch::area);
  return report;
}

nlohmann::ordered_json patch_json(const PatchReport& report, const Structure& structure) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const AtomPatch& patch : report.patches) {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t atom : patch.atoms) places.push_back(structure.atoms[atom].index);
    list.push_back({{"area", patch.area},
                    {"residues", residues_of(structure, patch.atoms)},
                    {"atoms", places},
                    {"atom_areas", patch.areas}});
  }
  return {{"selection", report.selection},
          {"least_area", report.least},
          {"area", report.area},
          {"count", report.count},
          {"list", list}};
}

std::string patch_table(const PatchReport& report, const Structure& structure) {
  std::string text =
      fmt::format("\n{:>9} {:>14} {:>9}  residues of {}\n", "patch", "area Å²", "atoms", in_quotes(report.selection));
  for (std::size_t n = 0; n < report.patches.size(); ++n) {
    const AtomPatch& patch = report.patches[n];
    text += fmt::format("{:>9} {:>13.3f} {:>9}  {}\n", n + 1, patch.area, patch.atoms.size(),
                        escaped(residues_of(structure, patch.atoms)));
  }
  return text + fmt::format("{:>9} {:>13.3f}            of {} patches; listed are those of at least {} Å²\n", "all",
                            report.area, with_thousands(report.count), report.least);
}

std::string patch_csv_header() { return "patch,area,atoms,residues\n"; }

std::string patch_csv_rows(const PatchReport& report, const Structure& structure, const std::string& prefix) {
  std::string rows;
  for (std::size_t n = 0; n < report.patches.size(); ++n) {
    const AtomPatch& patch = report.patches[n];
    rows += fmt::format("{}{},{:.6f},{},{}\n", prefix, n + 1, patch.area, patch.atoms.size(),
                        csv_cell(residues_of(structure, patch.atoms)));
  }
  return rows;
}

}  // namespace meniscus
