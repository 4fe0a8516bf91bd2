// SPDX-License-Identifier: BSD-3-Clause
// Written down from the bonds of the wwPDB's chemical components: what residues share stands once.
#include "core/structure/bonding_classes.h"

#include <map>
#include <utility>

#include "core/structure/canonical_names.h"

namespace meniscus {
namespace {

using Row = std::pair<const char*, const char*>;  // residue, "atom class atom class ..."

constexpr const char* kAminoAcid = "N N3H1 CA C4H1 C C3H0 O O1H0 OXT O2H1";

constexpr Row kSideChains[] = {
    {"ALA", "CB C4H3"},
    {"ARG", "CB C4H2 CG C4H2 CD C4H2 NE N3H1 CZ C3H0 NH1 N3H2 NH2 N3H2"},
    {"ASN", "CB C4H2 CG C3H0 OD1 O1H0 ND2 N3H2"},
    {"ASP", "CB C4H2 CG C3H0 OD1 O1H0 OD2 O2H1"},
    {"CYS", "CB C4H2 SG S2H1"},
    {"GLN", "CB C4H2 CG C4H2 CD C3H0 OE1 O1H0 NE2 N3H2"},
    {"GLU", "CB C4H2 CG C4H2 CD C3H0 OE1 O1H0 OE2 O2H1"},
    {"GLY", "CA C4H2"},
    {"HIS", "CB C4H2 CG C3H0 ND1 N3H1 CD2 C3H1 CE1 C3H1 NE2 N3H1"},
    {"ILE", "CB C4H1 CG1 C4H2 CG2 C4H3 CD1 C4H3"},
    {"LEU", "CB C4H2 CG C4H1 CD1 C4H3 CD2 C4H3"},
    {"LYS", "CB C4H2 CG C4H2 CD C4H2 CE C4H2 NZ N4H3"},
    {"MET", "CB C4H2 CG C4H2 SD S2H0 CE C4H3"},
    {"MSE", "CB C4H2 CG C4H2 SE SE2H0 CE C4H3"},
    {"PHE", "CB C4H2 CG C3H0 CD1 C3H1 CD2 C3H1 CE1 C3H1 CE2 C3H1 CZ C3H1"},
    {"PRO", "N N3H0 CB C4H2 CG C4H2 CD C4H2"},
    {"SEC", "CB C4H2 SE SE2H1"},
    {"SER", "CB C4H2 OG O2H1"},
    {"THR", "CB C4H1 OG1 O2H1 CG2 C4H3"},
    {"TRP", "CB C4H2 CG C3H0 CD1 C3H1 CD2 C3H0 NE1 N3H1 CE2 C3H0 CE3 C3H1 CZ2 C3H1 CZ3 C3H1 CH2 C3H1"},
    {"TYR", "CB C4H2 CG C3H0 CD1 C3H1 CD2 C3H1 CE1 C3H1 CE2 C3H1 CZ C3H0 OH O2H1"},
    {"VAL", "CB C4H1 CG1 C4H3 CG2 C4H3"},
};

constexpr const char* kSugarAndPhosphate =
    "OP3 O2H1 P P4H0 OP1 O1H0 OP2 O2H1 O5' O2H0 C5' C4H2 C4' C4H1 O4' O2H0 C3' C4H1 O3' O2H1 C2' C4H1 O2' O2H1 "
    "C1' C4H1";

constexpr Row kBases[] = {
    {"A", "N9 N3H0 C8 C3H1 N7 N2H0 C5 C3H0 C6 C3H0 N6 N3H2 N1 N2H0 C2 C3H1 N3 N2H0 C4 C3H0"},
    {"C", "N1 N3H0 C2 C3H0 O2 O1H0 N3 N2H0 C4 C3H0 N4 N3H2 C5 C3H1 C6 C3H1"},
    {"G", "N9 N3H0 C8 C3H1 N7 N2H0 C5 C3H0 C6 C3H0 O6 O1H0 N1 N3H1 C2 C3H0 N2 N3H2 N3 N2H0 C4 C3H0"},
    {"I", "N9 N3H0 C8 C3H1 N7 N2H0 C5 C3H0 C6 C3H0 O6 O1H0 N1 N3H1 C2 C3H1 N3 N2H0 C4 C3H0"},
    {"T", "N1 N3H0 C2 C3H0 O2 O1H0 N3 N3H1 C4 C3H0 O4 O1H0 C5 C3H0 C7 C4H3 C6 C3H1"},
    {"U", "N1 N3H0 C2 C3H0 O2 O1H0 N3 N3H1 C4 C3H0 O4 O1H0 C5 C3H1 C6 C3H1"},
};

constexpr Row kOthers[] = {{"HOH", "O O2H2"}, {"ACE", "C C3H0 O O1H0 CH3 C4H3"}, {"NH2", "N N3H2"}};

using Atoms = std::map<std::string_view, std::string_view>;

/// The later of two entries for an atom counts.
void add(Atoms& atoms, std::string_view row) {
  const auto field = [&row] {
    const std::string_view found = row.substr(0, row.find(' '));
    row.remove_prefix(std::min(row.size(), found.size() + 1));
    return found;
  };
  while (!row.empty()) {
    const std::string_view name = field();
    atoms[name] = field();
  }
}

std::map<std::string, Atoms, std::less<>> all_residues() {
  std::map<std::string, Atoms, std::less<>> residues;
  for (const auto& [name, row] : kSideChains) {
    add(residues[name], kAminoAcid);
    add(residues[name], row);
  }
  for (const auto& [name, row] : kBases) {
    for (const std::string& nucleotide : {std::string(name), std::string("D") + name}) {
      add(residues[nucleotide], kSugarAndPhosphate);
      add(residues[nucleotide], row);
      if (nucleotide.size() == 2) add(residues[nucleotide], "C2' C4H2");
    }
  }
  for (const auto& [name, row] : kOthers) add(residues[name], row);
  return residues;
}

}  // namespace

std::string_view bonding_class(const std::string& residue_name, const std::string& atom_name) {
  static const std::map<std::string, Atoms, std::less<>> kResidues = all_residues();
  const std::string canonical = canonical_residue(residue_name);
  const auto residue = kResidues.find(canonical);
  if (residue == kResidues.end()) return {};
  const auto atom = residue->second.find(canonical_atom(canonical, atom_name));
  return atom == residue->second.end() ? std::string_view() : atom->second;
}

}  // namespace meniscus
