// SPDX-License-Identifier: BSD-3-Clause
// Classes and elements of atoms by the names of their residues, with gemmi's tables of residues and elements.
#include "core/molecule/atom_classes.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gemmi/elem.hpp>
#include <gemmi/metadata.hpp>
#include <gemmi/resinfo.hpp>

#include "core/molecule/oddity.h"

namespace meniscus {
namespace {

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

std::string capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// The element of a lone atom that is named like its residue, or lies in a residue "ION": "CL", "Na+", "ZN2", and
/// CHARMM's own names.
gemmi::Element lone_ion_element(const Atom& atom) {
  static const std::map<std::string, gemmi::El> kCharmmIons{
      {"SOD", gemmi::El::Na}, {"CLA", gemmi::El::Cl}, {"POT", gemmi::El::K},  {"CAL", gemmi::El::Ca},
      {"CES", gemmi::El::Cs}, {"LIT", gemmi::El::Li}, {"RUB", gemmi::El::Rb}, {"BAR", gemmi::El::Ba}};
  const auto letters = [](const std::string& name) {
    return capitals(name.substr(0, name.find_first_of("0123456789+-")));
  };
  const std::string name = letters(atom.name);
  if (atom.residue_name != "ION" && name != letters(atom.residue_name)) return gemmi::El::X;
  const auto charmm = kCharmmIons.find(name);
  const gemmi::Element element = charmm != kCharmmIons.end() ? gemmi::Element(charmm->second) : gemmi::Element(name);
  return is_ion_element(element) ? element : gemmi::Element(gemmi::El::X);
}

/// The first letter of a name; two where only one element can be meant. Other letters are more often dummies and beads
/// (D, M, W) than deuterium and tungsten.
gemmi::Element element_by_letters(const Atom& atom) {
  const std::size_t letter = atom.name.find_first_not_of("0123456789");
  if (letter == std::string::npos) return gemmi::El::X;
  if (atom.kind != AtomClass::polymer) {
    const std::string two = capitals(atom.name.substr(letter, 2));
    for (const char* symbol : {"CL", "BR", "FE", "ZN", "MG", "MN", "SI", "SE"}) {
      if (two == symbol) return gemmi::Element(two);
    }
  }
  const char first = static_cast<char>(std::toupper(static_cast<unsigned char>(atom.name[letter])));
  return std::string_view("HCNOPSFIB").find(first) == std::string_view::npos ? gemmi::Element(gemmi::El::X)
                                                                             : gemmi::Element(std::string(1, first));
}

gemmi::Element element_of(gemmi::Element stated, gemmi::Element hint, const Atom& atom) {
  if (is_of_organic_residues(stated)) return stated;
  const gemmi::Element given = stated == gemmi::El::X ? hint : stated;
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(atom.residue_name);
  const bool standard =
      residue.found() && residue.is_standard() && (residue.is_amino_acid() || residue.is_nucleic_acid());
  const bool variant = stated == gemmi::El::X && !residue.found() && atom.kind == AtomClass::polymer &&
                       is_amino_acid_atom_name(atom.name);
  const bool doubtful = (standard || variant) && !is_of_organic_residues(given);
  return doubtful || given == gemmi::El::X ? element_by_letters(atom) : given;
}

/// Atoms first..last are one residue: sets their class and elements.
void classify_residue(std::vector<Atom>& atoms, std::size_t first, std::size_t last,
                      const std::vector<AtomHints>& hints, Oddity& impossible) {
  const AtomHints none;
  const auto hint = [&](std::size_t n) -> const AtomHints& { return hints.empty() ? none : hints[n]; };
  std::set<std::string> names;
  for (std::size_t n = first; n < last; ++n) names.insert(atoms[n].name);
  const bool lone_without_element = names.size() == 1 && atoms[first].element == 0;
  const gemmi::Element ion = lone_without_element ? lone_ion_element(atoms[first]) : gemmi::Element(gemmi::El::X);
  const gemmi::Element stated(int{atoms[first].element != 0 ? atoms[first].element : hint(first).element});
  const AtomClass kind =
      classify(atoms[first].residue_name, hint(first).residue, ion == gemmi::El::X ? stated : ion, names);
  for (std::size_t n = first; n < last; ++n) {
    atoms[n].kind = kind;
    const gemmi::Element element =
        kind == AtomClass::ion && ion != gemmi::El::X
            ? ion
            : element_of(gemmi::Element(int{atoms[n].element}), gemmi::Element(int{hint(n).element}), atoms[n]);
    if (atoms[n].element != 0 && atoms[n].element != element.atomic_number())
      impossible.add(fmt::format("{}: {}", label_of(atoms[n]), gemmi::Element(int{atoms[n].element}).name()));
    atoms[n].element = static_cast<std::uint8_t>(element.atomic_number());
  }
}

}  // namespace

bool is_water_name(const std::string& residue_name) {
  static const std::set<std::string> kWaters{"HOH", "DOD",  "WAT",  "H2O",  "OH2",  "SOL",   "TIP",
                                             "TP3", "TIP2", "TIP3", "TIP4", "TIP5", "T3P",   "T4P",
                                             "T5P", "SPC",  "SPCE", "HHO",  "OHH",  "TIP3P", "TIP4P"};
  return kWaters.contains(residue_name);
}

bool is_tabulated_residue(const std::string& residue_name) {
  return gemmi::find_tabulated_residue(residue_name).found();
}

void classify_atoms(std::vector<Atom>& atoms, std::vector<Warning>& warnings, const std::vector<AtomHints>& hints) {
  Oddity impossible;
  for (std::size_t first = 0, last = 0; first < atoms.size(); first = last) {
    while (last < atoms.size() && atoms[last].residue == atoms[first].residue &&
           atoms[last].residue_name == atoms[first].residue_name) {
      ++last;
    }
    classify_residue(atoms, first, last, hints, impossible);
  }
  impossible.warn(warnings, "an element that its residue cannot hold; its name was believed instead");
}

}  // namespace meniscus
