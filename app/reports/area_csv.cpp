// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of quoted text and numbers.
#include "app/reports/area_csv.h"

#include <fmt/format.h>

#include "core/base/text.h"
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

// model, chain, residue, number, icode
std::string place(const Atom& atom) {
  return fmt::format("{},{},{},{},{}", atom.model, csv_cell(atom.chain), csv_cell(atom.residue_name),
                     atom.residue_number, letter(atom.insertion_code));
}

// What kAtomColumns names.
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

std::string residue_csv_header(const std::vector<AreaColumn>& columns) {
  return header("model,chain,residue,number,icode,class,atoms", columns);
}

std::string residue_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                             const std::string& prefix) {
  std::string text;
  for (const AtomGroup& group : group_atoms(structure, Grouping::residue)) {
    const Atom& atom = structure.atoms[group.atoms.front()];
    text += fmt::format("{}{},{},{}", prefix, place(atom), class_name(atom.kind), group.atoms.size());
    for (const AreaColumn& column : columns) text += fmt::format(",{:.6f}", column.total_of(group));
    text += "\n";
  }
  return text;
}

}  // namespace meniscus
