// SPDX-License-Identifier: BSD-3-Clause
// gemmi's table of common residues, and the names that it does not know.
#include "core/structure/residue_names.h"

#include <set>

#include <gemmi/resinfo.hpp>

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
  static const std::set<std::string> kWaters{"HOH", "DOD",  "WAT",  "H2O",  "OH2",  "SOL",   "TIP",
                                             "TP3", "TIP2", "TIP3", "TIP4", "TIP5", "T3P",   "T4P",
                                             "T5P", "SPC",  "SPCE", "HHO",  "OHH",  "TIP3P", "TIP4P"};
  return kWaters.contains(residue_name);
}

}  // namespace meniscus
