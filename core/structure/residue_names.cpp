// SPDX-License-Identifier: BSD-3-Clause
// Looks names of residues and atoms up in tables of the wwPDB and of force fields.
#include "core/structure/residue_names.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <gemmi/resinfo.hpp>

#include "core/structure/structure.h"

namespace meniscus {

bool is_amino_acid_name(const std::string& residue_name) {
  return gemmi::find_tabulated_residue(residue_name).is_amino_acid() || is_chain_cap_name(residue_name);
}

bool is_chain_cap_name(const std::string& residue_name) {
  static const std::set<std::string> kCaps{"ACE", "NME", "NMA", "NH2", "FOR"};
  return kCaps.contains(residue_name);
}

bool is_nucleotide_name(const std::string& residue_name) {
  static const std::set<std::string> kOther{"ADE", "CYT", "GUA", "THY", "URA", "URI", "RA",  "RC",  "RG",
                                            "RU",  "RA3", "RC3", "RG3", "RU3", "RA5", "RC5", "RG5", "RU5",
                                            "DA3", "DC3", "DG3", "DT3", "DA5", "DC5", "DG5", "DT5", "A3",
                                            "C3",  "G3",  "U3",  "A5",  "C5",  "G5",  "U5"};
  return gemmi::find_tabulated_residue(residue_name).is_nucleic_acid() || kOther.contains(residue_name);
}

bool is_water_name(const std::string& residue_name) {
  static const std::set<std::string> kWaters{"HOH",  "DOD",  "WAT",  "H2O",   "OH2",   "SOL",  "TIP", "TP3",
                                             "TIP2", "TIP3", "TIP4", "TIP5",  "T3P",   "T4P",  "T5P", "SPC",
                                             "SPCE", "HHO",  "OHH",  "TIP3P", "TIP4P", "SWM4", "SWM6"};
  return kWaters.contains(residue_name);
}

namespace {

const std::map<std::string_view, std::string_view> kResidues{
    {"HID", "HIS"},  {"HIE", "HIS"},  {"HIP", "HIS"},  {"HSD", "HIS"},  {"HSE", "HIS"},  {"HSP", "HIS"},
    {"HISA", "HIS"}, {"HISB", "HIS"}, {"HISD", "HIS"}, {"HISE", "HIS"}, {"HISH", "HIS"}, {"CYX", "CYS"},
    {"CYM", "CYS"},  {"CYS2", "CYS"}, {"CYSH", "CYS"}, {"ASH", "ASP"},  {"ASPH", "ASP"}, {"GLH", "GLU"},
    {"GLUH", "GLU"}, {"LYN", "LYS"},  {"LYSH", "LYS"}, {"ARGN", "ARG"}, {"ADE", "A"},    {"CYT", "C"},
    {"GUA", "G"},    {"URA", "U"},    {"URI", "U"},    {"THY", "DT"},   {"RA", "A"},     {"RC", "C"},
    {"RG", "G"},     {"RU", "U"},     {"RA3", "A"},    {"RC3", "C"},    {"RG3", "G"},    {"RU3", "U"},
    {"RA5", "A"},    {"RC5", "C"},    {"RG5", "G"},    {"RU5", "U"},    {"A3", "A"},     {"C3", "C"},
    {"G3", "G"},     {"U3", "U"},     {"A5", "A"},     {"C5", "C"},     {"G5", "G"},     {"U5", "U"},
    {"DA3", "DA"},   {"DC3", "DC"},   {"DG3", "DG"},   {"DT3", "DT"},   {"DA5", "DA"},   {"DC5", "DC"},
    {"DG5", "DG"},   {"DT5", "DT"}};

const std::map<std::string_view, std::string_view> kAtoms{{"O1P", "OP1"}, {"O2P", "OP2"}, {"O3P", "OP3"},
                                                          {"C5M", "C7"},  {"HN", "H"},    {"OT1", "O"},
                                                          {"OT2", "OXT"}, {"OT", "OXT"}};

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

/// Adds the entries of a row. A later entry for an atom replaces an earlier one.
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

/// Returns the atoms of a residue by its canonical name. The result is empty if it is not known.
const Atoms& atoms_of(const std::string& canonical) {
  static const std::map<std::string, Atoms, std::less<>> kTables = all_residues();
  static const Atoms kNone;
  const auto residue = kTables.find(canonical);
  return residue == kTables.end() ? kNone : residue->second;
}

}  // namespace

std::string canonical_residue(const std::string& residue_name) {
  if (is_water_name(residue_name)) return "HOH";
  const auto found = kResidues.find(residue_name);
  return found == kResidues.end() ? residue_name : std::string(found->second);
}

char residue_letter(const std::string& residue_name) {
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(canonical_residue(residue_name));
  return std::isalpha(static_cast<unsigned char>(info.one_letter_code))
             ? static_cast<char>(std::toupper(static_cast<unsigned char>(info.one_letter_code)))
             : 'X';
}

std::string canonical_atom(std::string_view residue, const std::string& atom_name) {
  if (residue == "ILE" && atom_name == "CD") return "CD1";
  const bool is_end = atom_name == "O1" || atom_name == "O2" || atom_name == "OC1" || atom_name == "OC2";
  if (is_end && atoms_of(std::string(residue)).contains("OXT")) return atom_name.back() == '1' ? "O" : "OXT";
  if (residue == "HOH" && (atom_name == "OW" || atom_name == "OH2" || atom_name == "OH")) return "O";
  const auto found = kAtoms.find(atom_name);
  std::string name = found == kAtoms.end() ? atom_name : std::string(found->second);
  std::replace(name.begin(), name.end(), '*', '\'');
  return name;
}

std::string_view bonding_class(const std::string& residue_name, const std::string& atom_name) {
  const std::string canonical = canonical_residue(residue_name);
  const Atoms& atoms = atoms_of(canonical);
  const auto atom = atoms.find(canonical_atom(canonical, atom_name));
  return atom == atoms.end() ? std::string_view() : atom->second;
}

std::size_t heavy_atoms_of(const std::string& residue_name) { return atoms_of(canonical_residue(residue_name)).size(); }

namespace {

// Components of the wwPDB: phospholipids, cardiolipin, galactolipids, fatty acids, acylglycerols, sterols,
// sphingolipids.
const std::set<std::string_view> kComponents{
    "PC1", "PCW", "POV", "PEE", "PEV", "PEF", "PEH", "PEK", "PGV", "PGT", "PTY", "3PE", "3PH", "6PL", "PX4",
    "MC3", "PLC", "PCF", "PCK", "HGX", "PSF", "P5S", "PIO", "L9Q", "8PE", "9PE", "LHG", "LMG", "DGD", "SQD",
    "DGA", "CDL", "PEU", "GGD", "CLR", "CHS", "Y01", "ERG", "CLL", "HC3", "PLM", "OLA", "OLB", "OLC", "STE",
    "MYR", "PAM", "EIC", "ACD", "LNL", "DCR", "LPE", "LPC", "LPP", "CN3", "PGW", "PGK", "PSC", "D21", "DLP",
    "MPG", "46E", "SPH", "CER", "SLU", "HXJ", "LNG", "PIE", "DDR", "D3D", "HP6"};
// Names of CHARMM, GROMOS and Martini that are not made of the letters of tails and head.
const std::set<std::string_view> kForceFields{
    "CHL1", "CHOL", "CHNS", "ERGO", "SITO", "STIG", "CAMP", "PSM",  "SSM",  "NSM",  "LSM",  "BSM",  "OSM",
    "DPSM", "DBSM", "PBSM", "POSM", "TOCL", "TMCL", "CDL0", "CDL1", "CDL2", "PALM", "STEA", "OLEO", "LAUR",
    "MYRI", "DPG1", "DPG3", "DPGS", "POP1", "POP2", "POP3", "DPP1", "DPP2", "SAPI", "TAG",  "DPCE", "POGL"};
// Heads and tails of AMBER. Their names are too short to identify a lipid by one of them alone.
const std::set<std::string_view> kHeads{"PC", "PE", "PS", "PGR", "PH-", "PGS", "CHL", "SPM"};
const std::set<std::string_view> kTails{"LAL", "MY", "PA", "ST", "OL", "AR", "DHA", "SA"};

constexpr std::string_view kTailLetters =
    " DL DM DP DS DO DY DI DA DB DX DF DG DU DV DT DN DR PO SO PL SL PA SA PD SD PI PU "
    "PR PG PE PQ OP PP JP JF MO MP LP OL LO QM ";
constexpr std::string_view kHeadLetters = " PC PE PG PS PA PI ";

bool is_named_by_letters(std::string_view name) {
  const auto among = [](std::string_view list, std::string_view letters) {
    return list.find(' ' + std::string(letters) + ' ') != std::string_view::npos;
  };
  return name.size() == 4 && among(kTailLetters, name.substr(0, 2)) && among(kHeadLetters, name.substr(2));
}

/// True if the residue has ten carbon atoms or more, as a residue with a tail has. Others may have the same names.
bool has_tail(std::span<const Atom> residue) {
  return std::ranges::count_if(residue, [](const Atom& atom) { return atom.element == 6; }) >= 10;
}

}  // namespace

bool is_lipid(std::span<const Atom> residue) {
  const Atom& head = residue.front();
  if (head.kind != AtomClass::ligand) return false;
  const std::string& name = head.residue_name;
  if (is_named_by_letters(name) || kForceFields.contains(name)) return true;
  if (head.element == 0 && std::ranges::any_of(residue, [](const Atom& atom) {
        return atom.name == "GL1" || atom.name == "AM1" || atom.name == "PO4";
      }))
    return true;
  // The atoms are P31 of AMBER's heads, and O1 of its cholesterol.
  if (kHeads.contains(name))
    return std::ranges::any_of(residue, [](const Atom& atom) { return atom.name == "P31" || atom.name == "O1"; });
  return (kComponents.contains(name) || kTails.contains(name)) && has_tail(residue);
}

}  // namespace meniscus
