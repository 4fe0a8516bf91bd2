// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of quoted text and numbers.
#include "app/reports/area_csv.h"

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/structure/radii.h"

namespace meniscus {
namespace {

std::string cell(const std::string& text) {
  std::string quoted = escaped(text);
  if (quoted.find_first_of(",\" ") == std::string::npos) return quoted;
  for (std::size_t at = 0; (at = quoted.find('"', at)) != std::string::npos; at += 2) quoted.insert(at, 1, '"');
  return '"' + quoted + '"';
}

std::string letter(char c) { return c == ' ' ? "" : cell(std::string(1, c)); }

std::string header(const std::string& first, const std::vector<AreaColumn>& columns) {
  std::string line = first;
  for (const AreaColumn& column : columns) line += "," + column.name;
  return line + "\n";
}

// model, chain, residue, number, icode
std::string place(const Atom& atom) {
  return fmt::format("{},{},{},{},{}", atom.model, cell(atom.chain), cell(atom.residue_name), atom.residue_number,
                     letter(atom.insertion_code));
}

}  // namespace

std::string atom_csv(const Structure& structure, const std::vector<AreaColumn>& columns) {
  std::string text = header("index,model,chain,residue,number,icode,name,element,class,radius", columns);
  for (std::size_t a = 0; a < structure.atoms.size(); ++a) {
    const Atom& atom = structure.atoms[a];
    text += fmt::format("{},{},{},{},{},{}", atom.index, place(atom), cell(atom.name),
                        atom.element ? element_symbol(atom.element) : "", class_name(atom.kind), atom.radius);
    for (const AreaColumn& column : columns) text += fmt::format(",{:.6f}", column.values[a]);
    text += "\n";
  }
  return text;
}

std::string residue_csv(const Structure& structure, const std::vector<AreaColumn>& columns) {
  std::string text = header("model,chain,residue,number,icode,class,atoms", columns);
  for (const AtomGroup& group : group_atoms(structure, Grouping::residue)) {
    const Atom& atom = structure.atoms[group.atoms.front()];
    text += fmt::format("{},{},{}", place(atom), class_name(atom.kind), group.atoms.size());
    for (const AreaColumn& column : columns) text += fmt::format(",{:.6f}", column.total_of(group));
    text += "\n";
  }
  return text;
}

}  // namespace meniscus
