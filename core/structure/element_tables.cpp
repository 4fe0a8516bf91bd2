// SPDX-License-Identifier: BSD-3-Clause
// Holds the radii of Bondi 1964 and Mantina et al. 2009 in the layout of the periodic table, the hydropathy of Kyte and
// Doolittle, and the greatest areas of Tien et al. 2013.
#include "core/structure/element_tables.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <limits>
#include <map>

namespace meniscus {
namespace {

// clang-format off
constexpr const char* kSymbols[] = {"X",
  "H",                                                                                                  "He",
  "Li", "Be",                                                             "B",  "C",  "N",  "O",  "F",  "Ne",
  "Na", "Mg",                                                             "Al", "Si", "P",  "S",  "Cl", "Ar",
  "K",  "Ca", "Sc", "Ti", "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga", "Ge", "As", "Se", "Br", "Kr",
  "Rb", "Sr", "Y",  "Zr", "Nb", "Mo", "Tc", "Ru", "Rh", "Pd", "Ag", "Cd", "In", "Sn", "Sb", "Te", "I",  "Xe",
  "Cs", "Ba", "La", "Ce", "Pr", "Nd", "Pm", "Sm", "Eu", "Gd", "Tb", "Dy", "Ho", "Er", "Tm", "Yb", "Lu",
              "Hf", "Ta", "W",  "Re", "Os", "Ir", "Pt", "Au", "Hg", "Tl", "Pb", "Bi", "Po", "At", "Rn",
  "Fr", "Ra", "Ac", "Th", "Pa", "U",  "Np", "Pu", "Am", "Cm", "Bk", "Cf", "Es", "Fm", "Md", "No", "Lr",
              "Rf", "Db", "Sg", "Bh", "Hs", "Mt", "Ds", "Rg", "Cn", "Nh", "Fl", "Mc", "Lv", "Ts", "Og"};
static_assert(std::size(kSymbols) == 119);

// Radii in Å from Bondi's tables I, II and (metals) III, with 1.20 for hydrogen, which he recommends for bonded H. 0:
// not given.
constexpr double kBondi[] = {0,
  1.20,                                                                                                 1.40,
  1.82, 0,                                                                0,    1.70, 1.55, 1.52, 1.47, 1.54,
  2.27, 1.73,                                                             0,    2.10, 1.80, 1.80, 1.75, 1.88,
  2.75, 0,    0,    0,    0,    0,    0,    0,    0,    1.63, 1.40, 1.39, 1.87, 0,    1.85, 1.90, 1.85, 2.02,
  0,    0,    0,    0,    0,    0,    0,    0,    0,    1.63, 1.72, 1.58, 1.93, 2.17, 0,    2.06, 1.98, 2.16,
  0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
              0,    0,    0,    0,    0,    0,    1.72, 1.66, 1.55, 1.96, 2.02, 0,    0,    0,    0,
  0,    0,    0,    0,    0,    1.86};
// clang-format on

// Radii in Å by atomic number: the values of Mantina's table 12 that are new and consistent with Bondi's.
const std::map<std::uint8_t, double> kMantina{{4, 1.53},  {5, 1.92},  {13, 1.84}, {20, 2.31}, {32, 2.11}, {37, 3.03},
                                              {38, 2.49}, {51, 2.06}, {55, 3.43}, {56, 2.68}, {83, 2.07}, {84, 1.97},
                                              {85, 2.02}, {86, 2.20}, {87, 3.48}, {88, 2.83}};

}  // namespace

ElementRadius bondi_radius(std::uint8_t element) {
  if (element < std::size(kBondi) && kBondi[element] > 0.0) return {kBondi[element], RadiusSource::bondi};
  const auto found = kMantina.find(element);
  if (found != kMantina.end()) return {found->second, RadiusSource::mantina};
  return {kRadiusWithoutSource, RadiusSource::none};
}

const char* source_name(RadiusSource source) {
  switch (source) {
    case RadiusSource::bondi:
      return "Bondi 1964, 1966";
    case RadiusSource::mantina:
      return "Mantina et al. 2009";
    case RadiusSource::none:
      break;
  }
  return "no published value";
}

const char* element_symbol(std::uint8_t element) { return kSymbols[element < std::size(kSymbols) ? element : 0]; }

std::uint8_t element_of_symbol(std::string_view symbol) {
  if (symbol == "D" || symbol == "d" || symbol == "T" || symbol == "t") return 1;
  for (std::size_t element = 1; element < std::size(kSymbols); ++element) {
    const std::string_view known = kSymbols[element];
    const bool same = std::equal(symbol.begin(), symbol.end(), known.begin(), known.end(), [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    });
    if (same) return static_cast<std::uint8_t>(element);
  }
  return 0;
}

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct AminoAcid {
  std::string_view names;
  double hydropathy, greatest_area;
};

constexpr AminoAcid kAminoAcids[] = {{" ILE ", 4.5, 197},         {" VAL ", 4.2, 174},
                                     {" LEU ", 3.8, 201},         {" PHE ", 2.8, 240},
                                     {" CYS CYX CYM ", 2.5, 167}, {" MET MSE ", 1.9, 224},
                                     {" ALA ", 1.8, 129},         {" GLY ", -0.4, 104},
                                     {" THR ", -0.7, 172},        {" SER ", -0.8, 155},
                                     {" TRP ", -0.9, 285},        {" TYR ", -1.3, 263},
                                     {" PRO ", -1.6, 159},        {" HIS HID HIE HIP HSD HSE HSP ", -3.2, 224},
                                     {" GLU GLH ", -3.5, 223},    {" GLN ", -3.5, 225},
                                     {" ASP ASH ", -3.5, 193},    {" ASN ", -3.5, 195},
                                     {" LYS LYN ", -3.9, 236},    {" ARG ", -4.5, 274}};

double number_of(std::string_view residue_name, double AminoAcid::*number) {
  const std::string word = std::string(" ").append(residue_name).append(" ");
  for (const AminoAcid& entry : kAminoAcids)
    if (!residue_name.empty() && entry.names.find(word) != std::string_view::npos) return entry.*number;
  return kMissing;
}

}  // namespace

double hydropathy(std::string_view residue_name) { return number_of(residue_name, &AminoAcid::hydropathy); }

double greatest_accessible_area(std::string_view residue_name) {
  return number_of(residue_name, &AminoAcid::greatest_area);
}

}  // namespace meniscus
