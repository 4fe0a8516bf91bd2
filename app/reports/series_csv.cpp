// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of frames.
#include "app/reports/series_csv.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/reports/area_csv.h"
#include "core/surface/primitives.h"

namespace meniscus {

std::string frame_cells(const FrameNote& note) {
  return fmt::format("{},{}", note.frame, note.time ? fmt::format("{}", *note.time) : "");
}

std::vector<SeriesValue> series_values(const Molecule& molecule, const std::vector<AreaColumn>& columns) {
  double volume = 0.0, components = 0.0, cavities = 0.0, cavity_area = 0.0, cavity_volume = 0.0;
  for (const SurfaceObject& object : molecule.objects) {
    const auto copies = static_cast<double>(object.copies.size());
    volume += object.surface.volume * copies;
    components += static_cast<double>(object.surface.components.size()) * copies;
    for (const Component& component : object.surface.components) {
      if (component.kind != ComponentKind::cavity) continue;
      cavities += copies;
      cavity_area += component.area * copies;
      cavity_volume -= component.volume * copies;
    }
  }
  constexpr const char *kArea = "Å²", *kVolume = "Å³";
  std::vector<SeriesValue> values;
  for (const AreaColumn& column : columns) values.push_back({column.name, kArea, column.total});
  values.push_back({"volume", kVolume, volume});
  values.push_back({"components", "", components});
  values.push_back({"cavities", "", cavities});
  values.push_back({"cavity_area", kArea, cavity_area});
  values.push_back({"cavity_volume", kVolume, cavity_volume});
  return values;
}

std::string series_csv_header(const std::vector<SeriesValue>& values) {
  std::string line = kFrameColumns;
  for (const SeriesValue& value : values) line += "," + value.name;
  return line + "\n";
}

std::string series_csv_row(const std::vector<SeriesValue>& values, const FrameNote& note) {
  std::string line = frame_cells(note);
  for (const SeriesValue& value : values) line += fmt::format(",{:.{}f}", value.value, *value.unit ? 6 : 0);
  return line + "\n";
}

std::string residues_of(const Structure& structure, std::vector<std::uint32_t> atoms) {
  std::ranges::sort(atoms);
  std::string text;
  const Atom* previous = nullptr;
  for (const std::uint32_t a : atoms) {
    const Atom& atom = structure.atoms[a];
    if (previous && previous->residue == atom.residue) continue;
    previous = &atom;
    text += fmt::format("{}{}:{}:{}{}", text.empty() ? "" : " ", atom.chain == " " ? "" : atom.chain, atom.residue_name,
                        atom.residue_number, atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code));
  }
  return text;
}

std::string lining_residues(const Structure& structure, const SurfaceObject& object, const Cavity& cavity) {
  std::vector<std::uint32_t> atoms;
  for (const std::uint32_t a : cavity.atoms) atoms.push_back(object.atom[a]);
  return residues_of(structure, std::move(atoms));
}

std::string cavity_csv_header() {
  return std::string(kFrameColumns) + ",cavity,event,other,volume,area,x,y,z,atoms,residues\n";
}

std::string cavity_csv_row(const FrameNote& note, const CavityStep& step, const Cavity* cavity,
                           const std::string& lining) {
  std::string line = fmt::format("{},{},{},{}", frame_cells(note), step.id, event_word(step.event),
                                 step.other ? fmt::format("{}", *step.other) : "");
  if (!cavity) return line + ",0,0,,,,0,\n";
  const glm::dvec3 middle = cavity->middle();
  return line + fmt::format(",{:.6f},{:.6f},{:.3f},{:.3f},{:.3f},{},{}\n", cavity->volume, cavity->area, middle.x,
                            middle.y, middle.z, cavity->atoms.size(), csv_cell(lining));
}

}  // namespace meniscus
