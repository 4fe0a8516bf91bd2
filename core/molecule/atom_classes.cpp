// SPDX-License-Identifier: BSD-3-Clause
// Classes and elements of atoms by the names of their residues, with gemmi's tables of residues and elements.
#include "core/molecule/atom_classes.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>

#include <gemmi/elem.hpp>
#include <gemmi/metadata.hpp>
#include <gemmi/resinfo.hpp>

namespace meniscus {
namespace {

/// Water by the names of the wwPDB and of molecular dynamics programs.
bool is_water_name(const std::string& name) {
  static const std::set<std::string> kWaters{"HOH", "DOD",  "WAT",  "H2O",  "OH2",  "SOL",   "TIP",
                                             "TP3", "TIP2", "TIP3", "TIP4", "TIP5", "T3P",   "T4P",
                                             "T5P", "SPC",  "SPCE", "HHO",  "OHH",  "TIP3P", "TIP4P"};
  return kWaters.contains(name);
}

/// Amino acids and nucleotides; names of force fields (HSD, CYX, DA5, ...) are found by their backbone instead.
bool is_polymer_name(const std::string& name) {
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(name);
  return residue.is_amino_acid() || residue.is_nucleic_acid();
}

/// Elements that stand alone in a file as ions: metals and halogens.
bool is_ion_element(gemmi::Element element) {
  switch (element.elem) {
    case gemmi::El::F:
    case gemmi::El::Cl:
    case gemmi::El::Br:
    case gemmi::El::I:
      return true;
    default:
      return element.elem != gemmi::El::X && gemmi::is_metal(element.elem);
  }
}

/// The class of one residue from its name, its file's statement, and its atoms (`names`: distinct atom names).
AtomClass classify(const std::string& residue_name, ResidueStatement statement, gemmi::Element first_element,
                   const std::set<std::string>& names) {
  if (is_water_name(residue_name)) return AtomClass::water;
  const bool polymer_name = is_polymer_name(residue_name);
  if (names.size() == 1 && !polymer_name && is_ion_element(first_element)) return AtomClass::ion;
  if (statement == ResidueStatement::polymer) return AtomClass::polymer;
  if (statement == ResidueStatement::other) return AtomClass::ligand;
  const bool peptide = names.contains("N") && names.contains("CA") && names.contains("C");
  const bool nucleotide = names.contains("C4'") || names.contains("C4*");
  return polymer_name || peptide || nucleotide ? AtomClass::polymer : AtomClass::ligand;
}

bool is_of_organic_residues(gemmi::Element element) {
  switch (element.elem) {
    case gemmi::El::C:
    case gemmi::El::N:
    case gemmi::El::O:
    case gemmi::El::S:
    case gemmi::El::P:
    case gemmi::El::Se:
      return true;
    default:
      return element.is_hydrogen();
  }
}

/// CA, CB, CG, CD, CE, CZ, NE1, OG, SG, HG21, ...: an element and a Greek letter, as in amino acids only.
bool is_amino_acid_atom_name(std::string_view name) {
  return name.size() >= 2 && std::string_view("CNOSH").find(name[0]) != std::string_view::npos &&
         std::string_view("ABGDEZH").find(name[1]) != std::string_view::npos &&
         name.find_first_not_of("0123456789", 2) == std::string_view::npos;
}

/// An unknown element is guessed from the first letter of the name, except D, which is more often a dummy than
/// deuterium.
gemmi::Element element_of(gemmi::Element stated, gemmi::Element hint, const Atom& atom) {
  if (is_of_organic_residues(stated)) return stated;
  const gemmi::Element given = stated == gemmi::El::X ? hint : stated;
  const std::size_t letter = atom.name.find_first_not_of("0123456789");
  if (letter == std::string::npos) return given;
  const gemmi::Element guess(atom.name.substr(letter, 1));
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(atom.residue_name);
  const bool standard =
      residue.found() && residue.is_standard() && (residue.is_amino_acid() || residue.is_nucleic_acid());
  const bool variant = stated == gemmi::El::X && !residue.found() && atom.kind == AtomClass::polymer &&
                       is_amino_acid_atom_name(atom.name);
  if ((standard || variant) && !is_of_organic_residues(given)) return guess;
  return given == gemmi::El::X && guess != gemmi::El::D ? guess : given;
}

}  // namespace

void classify_atoms(std::vector<Atom>& atoms, const std::vector<AtomHints>& hints) {
  const auto hint = [&](std::size_t n) { return hints.empty() ? AtomHints{} : hints[n]; };
  for (std::size_t first = 0, last = 0; first < atoms.size(); first = last) {
    std::set<std::string> names;
    const Atom head = atoms[first];
    while (last < atoms.size() && atoms[last].residue == head.residue &&
           atoms[last].residue_name == head.residue_name) {
      names.insert(atoms[last++].name);
    }
    const gemmi::Element head_element(int{head.element != 0 ? head.element : hint(first).element});
    const AtomClass kind = classify(head.residue_name, hint(first).residue, head_element, names);
    for (std::size_t n = first; n < last; ++n) {
      atoms[n].kind = kind;
      const gemmi::Element element =
          element_of(gemmi::Element(int{atoms[n].element}), gemmi::Element(int{hint(n).element}), atoms[n]);
      atoms[n].element = static_cast<std::uint8_t>(element.atomic_number());
    }
  }
}

}  // namespace meniscus
