// SPDX-License-Identifier: BSD-3-Clause
// Classifies residues as polymer, ligand, water or ion, and finds elements from names and masses.
#include "core/structure/atom_classes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <gemmi/elem.hpp>
#include <gemmi/metadata.hpp>
#include <gemmi/resinfo.hpp>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/structure/martini.h"
#include "core/structure/plausibility.h"
#include "core/structure/residue_names.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

bool is_tabulated_polymer(const std::string& name) {
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(name);
  return residue.is_amino_acid() || residue.is_nucleic_acid();
}

/// True for amino acids and nucleotides, including the names of force fields. The caps of chains are not included,
/// because they are polymer only where they cap a chain.
bool is_polymer_name(const std::string& name) {
  return is_tabulated_polymer(name) || is_tabulated_polymer(canonical_residue(name)) || is_nucleotide_name(name);
}

/// True for elements that occur alone as ions: metals and halogens.
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

/// The distinct names of the atoms of a residue.
using Names = std::set<std::string>;

bool is_named_like_polymer(const Names& names) {
  return (names.contains("N") && names.contains("CA") && names.contains("C")) || names.contains("C4'") ||
         names.contains("C4*");
}

/// True if some atom belongs to a backbone. Bare bases (ADE, URA) and other ligands may have the same names as residues
/// of force fields, but have no such atoms.
bool has_backbone(const Names& names) {
  return names.contains("CA") || names.contains("P") || names.contains("C4'") || names.contains("C4*");
}

/// True for a residue of a chain that has only CA or P, and for a chromophore with other names of the backbone. Its
/// links to other residues cannot be found.
bool has_no_ends(const Names& names) {
  return !names.contains("C") && !names.contains("N") && !names.contains("O3'") && !names.contains("O3*");
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

/// True for CA, CB, CG, CD, CE, CZ, NE1, OG, SG, HG21 and so on: an element and a Greek letter, as in amino acids.
bool is_amino_acid_atom_name(std::string_view name) {
  return name.size() >= 2 && std::string_view("CNOSH").find(name[0]) != std::string_view::npos &&
         std::string_view("ABGDEZH").find(name[1]) != std::string_view::npos &&
         name.find_first_not_of("0123456789", 2) == std::string_view::npos;
}

/// Returns the element of a lone atom that has the same name as its residue or is in a residue "ION": "CL", "Na+",
/// "ZN2", and CHARMM's own names. Returns X if it is no ion.
gemmi::Element lone_ion_element(const Atom& atom) {
  static const std::map<std::string, gemmi::El> kCharmmIons{
      {"SOD", gemmi::El::Na}, {"CLA", gemmi::El::Cl}, {"POT", gemmi::El::K},  {"CAL", gemmi::El::Ca},
      {"CES", gemmi::El::Cs}, {"LIT", gemmi::El::Li}, {"RUB", gemmi::El::Rb}, {"BAR", gemmi::El::Ba}};
  const auto letters = [](const std::string& name) {
    return upper_case(name.substr(0, name.find_first_of("0123456789+-")));
  };
  const std::string name = letters(atom.name);
  if (atom.residue_name != "ION" && name != letters(atom.residue_name)) return gemmi::El::X;
  const auto charmm = kCharmmIons.find(name);
  const gemmi::Element element = charmm != kCharmmIons.end() ? gemmi::Element(charmm->second) : gemmi::Element(name);
  return is_ion_element(element) ? element : gemmi::Element(gemmi::El::X);
}

/// Returns the element of two letters that a name means in nearly all of the wwPDB's chemical components except the
/// standard ones. Returns X if there is none.
gemmi::Element element_of_two_letters(const Atom& atom, bool of_polymer) {
  constexpr std::string_view kHalogens = " CL BR ",
                             kOthers = " FE ZN MG MN SI SE CU PT IR RU RH RE AU AS AL TE ";  // ignored in polymers
  const std::size_t letter = std::min(atom.name.find_first_not_of("0123456789"), atom.name.size());
  const std::string two = upper_case(atom.name.substr(letter, 2)), word = " " + two + " ";
  const bool known = two.size() == 2 && (kHalogens.find(word) != std::string_view::npos ||
                                         (!of_polymer && kOthers.find(word) != std::string_view::npos));
  return known ? gemmi::Element(two) : gemmi::Element(gemmi::El::X);
}

/// Returns the element of the first letter of a name. Letters such as D, M and W are not used, because they are more
/// often dummies and beads than deuterium and tungsten.
gemmi::Element element_by_letter(const Atom& atom) {
  const std::size_t letter = atom.name.find_first_not_of("0123456789");
  if (letter == std::string::npos) return gemmi::El::X;
  const char first = static_cast<char>(std::toupper(static_cast<unsigned char>(atom.name[letter])));
  return std::string_view("HCNOPSFIB").find(first) == std::string_view::npos ? gemmi::Element(gemmi::El::X)
                                                                             : gemmi::Element(std::string(1, first));
}

/// Chooses the element of an atom. stated: from the file, or X. hint: from the columns of the name, or X. of_polymer:
/// the residue has the atoms of an amino acid or nucleotide, in a chain or alone.
gemmi::Element element_of(gemmi::Element stated, gemmi::Element hint, const Atom& atom, bool of_polymer) {
  if (is_of_organic_residues(stated)) return stated;
  const gemmi::Element given = stated == gemmi::El::X ? hint : stated;
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(atom.residue_name);
  const bool standard = residue.found() && residue.is_standard() && atom.residue_name != "UNK" &&
                        (residue.is_amino_acid() || residue.is_nucleic_acid());
  if (stated == gemmi::El::X && atom.name == "SE" && bonding_class(atom.residue_name, atom.name).starts_with("SE"))
    return gemmi::El::Se;
  if (stated == gemmi::El::X && !standard) {
    const gemmi::Element two = element_of_two_letters(atom, of_polymer);
    if (two != gemmi::El::X) return two;
  }
  const bool variant = stated == gemmi::El::X && !residue.found() && of_polymer && is_amino_acid_atom_name(atom.name);
  const bool doubtful = (standard || variant) && !is_of_organic_residues(given);
  return doubtful || given == gemmi::El::X ? element_by_letter(atom) : given;
}

constexpr float kLightestAtom = 0.9F;  // atomic mass units; hydrogen weighs 1.008, Drude particles 0.4

/// True if an atom of this element may have this mass. Mass is moved between an atom and its hydrogens, and a united
/// atom includes the mass of its hydrogens. A mass of 0 or NaN gives no information.
bool may_weigh(gemmi::Element element, float mass) {
  if (!(mass > 0.0F)) return true;
  if (element.is_hydrogen()) return mass < 4.5F;
  constexpr double kMostMoved = 3.1;  // atomic mass units per hydrogen
  const std::size_t hydrogens = std::string_view(" SONC").find(element.name());
  const double borne = hydrogens == std::string_view::npos ? 0.0 : static_cast<double>(hydrogens);
  return std::abs(static_cast<double>(mass) - element.weight()) < 0.5 + kMostMoved * borne;
}

class Classifier {
 public:
  Classifier(std::vector<Atom>& atoms, std::span<const AtomHints> hints, std::span<const Bond> bonds)
      : atoms_(atoms), hints_(hints), bonds_(bonds), sites_(atoms.size()) {
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (n == 0 || atoms[n].residue != atoms[n - 1].residue || atoms[n].residue_name != atoms[n - 1].residue_name)
        begins_.push_back(n);
    }
    begins_.push_back(atoms.size());
  }

  std::vector<bool> run(std::vector<Warning>& warnings) {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      for (std::size_t n = begins_[r]; n < begins_[r + 1]; ++n) {
        sites_[n] = is_site(r, n);
        if (sites_[n]) atoms_[n].element = 0;
      }
    }
    const bool of_beads = holds_beads();
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const Names names = names_of(r);
      if (of_beads && !consists_of_atoms(r, names))
        classify_beads(r, names);
      else
        classify(r, names);
    }
    impossible_.warn(warnings, "an element that its residue cannot have; the atom's name was used instead");
    return std::move(sites_);
  }

 private:
  const Atom& head(std::size_t r) const { return atoms_[begins_[r]]; }

  AtomHints hint(std::size_t atom) const { return hints_.empty() ? AtomHints{} : hints_[atom]; }

  /// Returns the names of the atoms of a residue, without virtual sites.
  Names names_of(std::size_t r) const {
    Names names;
    for (std::size_t n = begins_[r]; n < begins_[r + 1]; ++n)
      if (!sites_[n]) names.insert(atoms_[n].name);
    return names;
  }

  /// True if an atom is a virtual site or Drude particle, by its hint, or by its name and the atoms next to it. The
  /// latter is not tried in residues that are too large.
  bool is_site(std::size_t r, std::size_t n) const {
    constexpr std::size_t kLargestResidue = 1'000;
    const Atom& atom = atoms_[n];
    const std::string& name = atom.name;
    if (hint(n).is_site || atom.element > 1 || name.size() < 2 || begins_[r + 1] - begins_[r] > kLargestResidue)
      return hint(n).is_site;
    const auto any_other = [&](auto&& is) {
      const auto first = atoms_.begin() + static_cast<std::ptrdiff_t>(begins_[r]),
                 last = atoms_.begin() + static_cast<std::ptrdiff_t>(begins_[r + 1]);
      return std::any_of(first, last, [&](const Atom& other) { return &other != &atom && is(other); });
    };
    // Å. No bond is as short as this. Deuterium is as near only to the hydrogen that it was exchanged for.
    constexpr double kDrudeReach = 0.5;
    if (name[0] == 'D' && !(hint(n).mass > kLightestAtom))
      return any_other([&](const Atom& other) {
        return other.name[0] != 'D' && other.name[0] != 'H' && other.altloc == atom.altloc &&
               glm::distance(other.position, atom.position) < kDrudeReach;
      });
    if (atom.element != 0) return false;
    if (name == "OM" && is_water_name(atom.residue_name))
      return any_other([](const Atom& other) { return other.name[0] == 'O'; });
    // A dummy mass is named by an M, the first two letters of the carbon or nitrogen of XH3, and a number.
    const std::string_view heavy = std::string_view(name).substr(1, name.size() - 2);
    if (name[0] != 'M' || heavy.empty() || heavy.size() > 2 || (name.back() != '1' && name.back() != '2')) return false;
    return (is_polymer_name(atom.residue_name) || is_chain_cap_name(atom.residue_name)) &&
           (heavy[0] == 'C' || heavy[0] == 'N') &&
           any_other([&](const Atom& other) { return other.name.starts_with(heavy); });
  }

  bool consists_of_atoms(std::size_t r, const Names& names) const {
    return is_named_like_polymer(names) || is_water_name(head(r).residue_name);
  }

  bool holds_beads() const {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const auto first = atoms_.begin() + static_cast<std::ptrdiff_t>(begins_[r]),
                 last = atoms_.begin() + static_cast<std::ptrdiff_t>(begins_[r + 1]);
      if (std::none_of(first, last, [](const Atom& atom) { return is_martini_mark(atom.name); })) continue;
      const Names names = names_of(r);
      if (!consists_of_atoms(r, names) &&
          has_martini_names(first->residue_name, std::vector<std::string>(names.begin(), names.end())))
        return true;
    }
    return false;
  }

  /// Sets class and element of beads. A bead stands for several atoms and has no element, whatever its name or a column
  /// of the file suggests.
  void classify_beads(std::size_t r, const Names& names) {
    const std::string& name = head(r).residue_name;
    const bool of_chain = names.contains("BB") || (names.contains("BB1") && names.contains("BB2"));
    const AtomClass kind = is_martini_water(name)                      ? AtomClass::water
                           : names.size() == 1 && is_martini_ion(name) ? AtomClass::ion
                           : of_chain                                  ? AtomClass::polymer
                                                                       : AtomClass::ligand;
    for (std::size_t n = begins_[r]; n < begins_[r + 1]; ++n) {
      atoms_[n].kind = kind;
      atoms_[n].element = 0;
    }
  }

  void classify(std::size_t r, const Names& names) {
    const bool lone_without_element = names.size() == 1 && head(r).element == 0;
    const gemmi::Element ion = lone_without_element ? lone_ion_element(head(r)) : gemmi::Element(gemmi::El::X);
    const AtomHints first = hint(begins_[r]);
    const gemmi::Element stated(int{head(r).element != 0 ? head(r).element : first.element});
    const AtomClass kind = class_of(r, names, ion == gemmi::El::X ? stated : ion);
    const bool of_polymer =
        kind == AtomClass::polymer || (kind == AtomClass::ligand && first.residue == ResidueStatement::none &&
                                       (is_tabulated_polymer(head(r).residue_name) || is_named_like_polymer(names)));
    for (std::size_t n = begins_[r]; n < begins_[r + 1]; ++n) {
      atoms_[n].kind = kind;
      set_element(n, kind == AtomClass::ion ? ion : gemmi::Element(gemmi::El::X), of_polymer);
    }
  }

  AtomClass class_of(std::size_t r, const Names& names, gemmi::Element first_element) {
    const std::string& name = head(r).residue_name;
    if (is_water_name(name)) return AtomClass::water;
    if (names.size() == 1 && !is_tabulated_polymer(name) && is_ion_element(first_element)) return AtomClass::ion;
    const ResidueStatement statement = hint(begins_[r]).residue;
    if (statement != ResidueStatement::none)
      return statement == ResidueStatement::polymer ? AtomClass::polymer : AtomClass::ligand;
    return is_polymer(r, names) ? AtomClass::polymer : AtomClass::ligand;
  }

  bool is_polymer(std::size_t r, const Names& names) {
    const std::string& name = head(r).residue_name;
    const bool named = is_tabulated_polymer(name) || (is_polymer_name(name) && has_backbone(names));
    if (named && !hint(begins_[r]).is_heteroatom) return true;
    if (!linked_) linked_ = linked_residues(atoms_, bonds_);
    if ((*linked_)[head(r).residue]) return true;
    return named && (has_no_ends(names) || (in_chain(r, r - 1) && in_chain(r, r + 1)));
  }

  /// True if the previous or next residue in the file is in the same chain and has a lower or higher number.
  bool in_chain(std::size_t r, std::size_t neighbor) const {
    if (neighbor >= begins_.size() - 1) return false;  // r - 1 is the largest number if r is the first residue
    const Atom &here = head(r), &there = head(neighbor);
    return is_polymer_name(there.residue_name) && !hint(begins_[neighbor]).is_heteroatom && there.chain == here.chain &&
           there.segment == here.segment && there.model == here.model &&
           (neighbor < r ? there.residue_number < here.residue_number : here.residue_number < there.residue_number);
  }

  /// Sets the element of atom n. ion: the element of a lone ion, or X.
  void set_element(std::size_t n, gemmi::Element ion, bool of_polymer) {
    Atom& atom = atoms_[n];
    if (sites_[n]) return;
    gemmi::Element element = ion != gemmi::El::X ? ion
                                                 : element_of(gemmi::Element(int{atom.element}),
                                                              gemmi::Element(int{hint(n).element}), atom, of_polymer);
    if (atom.element != 0 && atom.element != element.atomic_number())
      impossible_.add(fmt::format("{}: {}", label_of(atom), gemmi::Element(int{atom.element}).name()));
    if (atom.element == 0 && !may_weigh(element, hint(n).mass)) element = gemmi::El::X;
    sites_[n] = element == gemmi::El::X && hint(n).mass == 0.0F;
    atom.element = static_cast<std::uint8_t>(element.atomic_number());
  }

  std::vector<Atom>& atoms_;
  std::span<const AtomHints> hints_;
  std::span<const Bond> bonds_;
  std::vector<bool> sites_;                  ///< true for virtual sites and Drude particles
  std::vector<std::size_t> begins_;          ///< first atom of each residue; the last entry is the number of atoms
  std::optional<std::vector<bool>> linked_;  ///< computed when it is first needed
  WarningCollector impossible_;
};

constexpr std::string_view kOrganic = "HCNOPS";

/// Returns the atomic number of the element with this weight, within 0.1; 0 if there is none.
int nearest_weight(double mass) {
  int best = 0;
  double least = 0.1;
  for (int number = 1; number < 119; ++number) {
    const double distance = std::abs(gemmi::Element(number).weight() - mass);
    if (distance < least) {
      least = distance;
      best = number;
    }
  }
  return best;
}

/// Returns the atomic number by mass, or 0 if the mass does not decide. Where mass was moved, carbon may weigh as much
/// as beryllium, and hydrogen as much as helium.
std::uint8_t element_of_mass(const std::string& name, float mass) {
  const gemmi::Element by_mass(nearest_weight(static_cast<double>(mass)));
  const std::string letters = upper_case(name.substr(std::min(name.find_first_not_of("0123456789"), name.size())));
  const bool named_organic = !letters.empty() && kOrganic.find(letters[0]) != std::string_view::npos;
  const bool moved_mass = named_organic && may_weigh(gemmi::Element(letters.substr(0, 1)), mass) &&
                          (by_mass == gemmi::El::He || !letters.starts_with(by_mass.uname()));
  return static_cast<std::uint8_t>(moved_mass ? 0 : by_mass.atomic_number());
}

}  // namespace

bool is_tabulated_residue(const std::string& residue_name) {
  return gemmi::find_tabulated_residue(residue_name).found();
}

bool is_site_symbol(std::string_view symbol) {
  const std::string letters = upper_case(symbol);
  return letters == "EP" || letters == "LP" || letters == "VS";
}

std::vector<bool> classify_atoms(std::vector<Atom>& atoms, std::vector<Warning>& warnings,
                                 std::span<const AtomHints> hints, std::span<const Bond> bonds) {
  return Classifier(atoms, hints, bonds).run(warnings);
}

void set_elements_by_mass(std::vector<Atom>& atoms, std::span<AtomHints> hints) {
  const bool weighed = std::ranges::any_of(hints, [](const AtomHints& hint) { return hint.mass > kLightestAtom; });
  for (std::size_t n = 0; n < hints.size(); ++n) {
    AtomHints& hint = hints[n];
    if (!weighed) hint.mass = std::numeric_limits<float>::quiet_NaN();
    hint.is_site = hint.is_site || (hint.mass > 0.0F && hint.mass < kLightestAtom);
    if (hint.is_site && n > 0 && !hints[n - 1].is_site && hint.mass < kLightestAtom) hints[n - 1].mass += hint.mass;
  }
  for (std::size_t n = 0; n < hints.size(); ++n)
    if (atoms[n].element == 0 && !hints[n].is_site) atoms[n].element = element_of_mass(atoms[n].name, hints[n].mass);
}

}  // namespace meniscus
