// SPDX-License-Identifier: BSD-3-Clause
// Writes ATOM and HETATM records in the columns of version 3.3 of the format.
#include "core/structure/formats/write_pdb.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostAtoms = 99999;

void check_room(const Atom& atom) {
  if (atom.residue_number < -999 || atom.residue_number > 9999)
    throw RequestError(
        fmt::format("{}: a PDB file has no room for residue number {}", atom_place(atom), atom.residue_number));
  if (atom.chain.size() > 2 || atom.name.size() > 4 || atom.residue_name.size() > 3)
    throw RequestError(fmt::format("{}: a PDB file has room for 2 letters of a chain, 4 of an atom and 3 of a residue",
                                   escaped(atom_place(atom))));
}

/// Returns the text for columns 13 to 16, where elements of one letter begin in the second column.
std::string name_field(const Atom& atom) {
  const std::string element = atom.element ? element_symbol(atom.element) : "";
  return atom.name.size() < 4 && element.size() < 2 ? " " + atom.name : atom.name;
}

double or_zero(float number) { return std::isfinite(number) ? number : 0.0; }

}  // namespace

PdbModels::PdbModels(const std::filesystem::path& path, Existing existing, std::span<const Atom> atoms)
    : atoms_(atoms), file_(path, existing) {
  if (atoms.size() > kMostAtoms)
    throw RequestError(fmt::format("{} atoms: a PDB file numbers {} at most; select fewer",
                                   with_thousands(atoms.size()), with_thousands(kMostAtoms)));
  for (const Atom& atom : atoms) check_room(atom);
}

void PdbModels::add(std::span<const glm::dvec3> positions) {
  std::string text = fmt::format("MODEL     {:>4}\n", ++models_);
  for (std::size_t n = 0; n < atoms_.size(); ++n) {
    const Atom& atom = atoms_[n];
    const glm::dvec3& x = positions[n];
    for (int axis = 0; axis < 3; ++axis)
      if (!(x[axis] > -999.9995 && x[axis] < 9999.9995))
        throw RequestError(
            fmt::format("{} is at {:.3f} Å, where a PDB file cannot have it", atom_place(atom), x[axis]));
    std::string element = atom.element ? element_symbol(atom.element) : "";
    for (char& letter : element)
      if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    text += fmt::format("{:<6}{:>5} {:<4} {:>3}{:>2}{:>4}{}   {:8.3f}{:8.3f}{:8.3f}{:6.2f}{:6.2f}          {:>2}\n",
                        atom.kind == AtomClass::polymer ? "ATOM" : "HETATM", n + 1, name_field(atom), atom.residue_name,
                        atom.chain, atom.residue_number, atom.insertion_code, x.x, x.y, x.z, or_zero(atom.occupancy),
                        glm::clamp(or_zero(atom.b_factor), -99.99, 999.99), element);
  }
  file_.write(text + "ENDMDL\n");
}

void PdbModels::commit() {
  file_.write("END\n");
  file_.commit();
}

}  // namespace meniscus
