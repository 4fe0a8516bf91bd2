// SPDX-License-Identifier: BSD-3-Clause
// The names of the wwPDB's chemical components, version 3, are the canonical ones.
#include "core/structure/canonical_names.h"

#include <algorithm>
#include <map>

#include "core/structure/residue_names.h"

namespace meniscus {
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

}  // namespace

std::string canonical_residue(const std::string& residue_name) {
  if (is_water_name(residue_name)) return "HOH";
  const auto found = kResidues.find(residue_name);
  return found == kResidues.end() ? residue_name : std::string(found->second);
}

std::string canonical_atom(std::string_view residue, const std::string& atom_name) {
  if (residue == "ILE" && atom_name == "CD") return "CD1";
  if (residue == "HOH" && (atom_name == "OW" || atom_name == "OH2" || atom_name == "OH")) return "O";
  const auto found = kAtoms.find(atom_name);
  std::string name = found == kAtoms.end() ? atom_name : std::string(found->second);
  std::replace(name.begin(), name.end(), '*', '\'');
  return name;
}

}  // namespace meniscus
