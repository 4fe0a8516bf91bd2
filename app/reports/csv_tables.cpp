// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of atoms, residues, frames and cavities, into a file or at once on standard output.
#include "app/reports/csv_tables.h"

#include <iostream>

#include "app/process/program_main.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

std::string letter(char c) { return c == ' ' ? "" : csv_cell(std::string(1, c)); }

std::string header(const std::string& first, const std::vector<AreaColumn>& columns) {
  std::string line = first;
  for (const AreaColumn& column : columns) line += "," + column.name;
  return line + "\n";
}

constexpr const char* kAtomColumns = "index,model,chain,residue,number,icode,name,element,class,radius";

// Returns the cells model,chain,residue,number,icode.
std::string place(const Atom& atom) {
  return fmt::format("{},{},{},{},{}", atom.model, csv_cell(atom.chain), csv_cell(atom.residue_name),
                     atom.residue_number, letter(atom.insertion_code));
}

// Adds a relative area after each accessible area by the probe of the largest ones.
std::vector<AreaColumn> with_relatives(const Structure& structure, std::vector<AreaColumn> columns,
                                       double probe_radius) {
  for (std::size_t n = 0, count = columns.size(); n < count; ++n)
    if (columns[n].name.starts_with("sas_area") && probe_radius == kAccessibilityProbe)
      columns.push_back({"relative_" + columns[n].name, relative_accessibility(structure, columns[n].values), 0.0});
  return columns;
}

// Returns the cells of kAtomColumns.
std::string atom_cells(const Atom& atom) {
  return fmt::format("{},{},{},{},{},{}", atom.index, place(atom), csv_cell(atom.name),
                     atom.element ? element_symbol(atom.element) : "", class_name(atom.kind), atom.radius);
}

}  // namespace

std::string csv_cell(const std::string& text) {
  std::string quoted = escaped(text);
  if (quoted.find_first_of(",\" ") == std::string::npos) return quoted;
  for (std::size_t at = 0; (at = quoted.find('"', at)) != std::string::npos; at += 2) quoted.insert(at, 1, '"');
  return '"' + quoted + '"';
}

std::string atom_csv_header(const std::vector<AreaColumn>& columns) { return header(kAtomColumns, columns); }

std::string atom_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                          const std::string& prefix) {
  std::string text;
  for (std::size_t a = 0; a < structure.atoms.size(); ++a) {
    text += prefix + atom_cells(structure.atoms[a]);
    for (const AreaColumn& column : columns) text += fmt::format(",{:.6f}", column.values[a]);
    text += "\n";
  }
  return text;
}

std::string gradient_csv_header(const std::vector<GradientColumn>& gradients) {
  std::string line = kAtomColumns;
  for (const GradientColumn& gradient : gradients)
    for (const char axis : {'x', 'y', 'z'}) line += fmt::format(",{}_d{}", gradient.name, axis);
  return line + "\n";
}

std::string gradient_csv_rows(const Structure& structure, const std::vector<GradientColumn>& gradients,
                              const std::string& prefix) {
  std::string text;
  for (std::size_t a = 0; a < structure.atoms.size(); ++a) {
    text += prefix + atom_cells(structure.atoms[a]);
    for (const GradientColumn& gradient : gradients)
      for (int axis = 0; axis < 3; ++axis) text += fmt::format(",{:.9f}", gradient.values[a][axis]);
    text += "\n";
  }
  return text;
}

std::string residue_csv_header(const std::vector<AreaColumn>& columns, double probe_radius) {
  return header("model,chain,residue,number,icode,class,atoms", with_relatives({}, columns, probe_radius));
}

std::string residue_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns, double probe_radius,
                             const std::string& prefix) {
  const std::vector<AreaColumn> all = with_relatives(structure, columns, probe_radius);
  std::string text;
  for (const AtomGroup& group : group_atoms(structure, Grouping::residue)) {
    const std::uint32_t first = group.atoms.front();
    const Atom& atom = structure.atoms[first];
    text += fmt::format("{}{},{},{}", prefix, place(atom), class_name(atom.kind), group.atoms.size());
    for (std::size_t n = 0; n < all.size(); ++n) {
      const double number = n < columns.size() ? all[n].total_of(group) : all[n].values[first];
      text += std::isnan(number) ? "," : fmt::format(",{:.6f}", number);
    }
    text += "\n";
  }
  return text;
}

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

void print_now(const std::string& text) {
  std::cout << text;
  finish_standard_output();
}

GrowingTable::GrowingTable(const std::string& path, Existing existing) : prints_(path == "-") {
  if (!path.empty() && !prints_) file_.emplace(path, existing);
}

void GrowingTable::write(const std::string& header, const std::string& rows) {
  if (!is_wanted()) return;
  const std::string text = has_header_ ? rows : header + rows;
  has_header_ = true;
  if (file_)
    file_->write(text);
  else
    print_now(text);
}

void GrowingTable::commit() {
  if (file_ && has_header_) file_->commit();
}

}  // namespace meniscus
