// SPDX-License-Identifier: BSD-3-Clause
// Holds the names of lipids.
#include "core/structure/lipids.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "core/structure/structure.h"

namespace meniscus {
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

/// True if the residue has ten carbon atoms or more, as a residue with a tail has. Short names are also those of other
/// residues.
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
