// SPDX-License-Identifier: BSD-3-Clause
// Holds the names of sugars with their symbols, and finds their rings.
#include "core/structure/sugars.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "core/structure/structure.h"

namespace meniscus {
namespace {

// The colours of the SNFG, as RGB from its page at the NCBI.
constexpr std::uint32_t kBlue = 0x0090bc, kGreen = 0x00a651, kYellow = 0xffd400, kLightBlue = 0x8fcce9,
                        kPink = 0xf69ea1, kPurple = 0xa54399, kBrown = 0xa17a4d, kOrange = 0xf47920, kRed = 0xed1c24;

struct SugarRow {
  Sugar sugar;
  std::string_view names;  ///< names of the wwPDB and of CHARMM
  char glycam;             ///< letter of GLYCAM, or blank
};

using enum SugarSolid;

constexpr SugarRow kSugars[] = {
    {{"Glc", sphere, kBlue}, "GLC BGC AGLC BGLC", 'G'},
    {{"Man", sphere, kGreen}, "MAN BMA AMAN BMAN", 'M'},
    {{"Gal", sphere, kYellow}, "GLA GAL AGAL BGAL", 'L'},
    {{"Gul", sphere, kOrange}, "GUP GL0", 'K'},
    {{"Alt", sphere, kPink}, "ALT", 'E'},
    {{"All", sphere, kPurple}, "AFD ALL", 'N'},
    {{"Tal", sphere, kLightBlue}, "TAL", 'T'},
    {{"Ido", sphere, kBrown}, "4N2", 'I'},
    {{"GlcNAc", cube, kBlue}, "NAG NDG AGLCNA BGLCNA BGLN AGLN", 'Y'},
    {{"ManNAc", cube, kGreen}, "BM3 BM7", 'W'},
    {{"GalNAc", cube, kYellow}, "A2G NGA AGALNA BGALNA BGAN AGAN", 'V'},
    {{"GlcN", divided_cube, kBlue}, "PA1 GCS SGN", ' '},
    {{"ManN", divided_cube, kGreen}, "95Z", ' '},
    {{"GalN", divided_cube, kYellow}, "X6X 1GN", ' '},
    {{"GlcA", divided_diamond, kBlue}, "GCU BDP AGLCA BGLCA", 'Z'},
    {{"ManA", divided_diamond, kGreen}, "MAV BEM", ' '},
    {{"GalA", divided_diamond, kYellow}, "ADA GTR", 'O'},
    {{"IdoA", divided_diamond, kBrown}, "IDR IDS AIDOA BIDOA", 'U'},
    {{"Fuc", cone, kRed}, "FUC FUL FCA FCB AFUC BFUC", 'f'},
    {{"AllNAc", cube, kPurple}, "NAA", ' '},
    {{"GulA", divided_diamond, kOrange}, "LGU", ' '},
    {{"Rha", cone, kGreen}, "RAM RM4 ARHM BRHM", 'h'},
    {{"Qui", cone, kBlue}, "G6D", 'q'},
    {{"Ara", star, kGreen}, "ARA ARB AHR FUB AARB BARB", 'a'},
    {{"Xyl", star, kOrange}, "XYS XYP AXYL BXYL", 'X'},
    {{"Rib", star, kPink}, "RIP 0MK RIB ARIB BRIB", ' '},
    {{"Lyx", star, kYellow}, "LDY", 'D'},
    {{"Neu5Ac", diamond, kPurple}, "SIA SLB ANE5AC BNE5AC ANE5", 'S'},
    {{"Neu5Gc", diamond, kLightBlue}, "NGC NGE", ' '},
    {{"Kdn", diamond, kGreen}, "KDM KDN", ' '},
    {{"LDManHep", hexagon, kGreen}, "GMH", ' '},
    {{"Kdo", hexagon, kYellow}, "KDO", ' '},
    {{"MurNAc", hexagon, kPurple}, "MUB AMU", ' '},
    {{"Bac", hexagon, kBlue}, "B6D", ' '},
    {{"Fru", pentagon, kGreen}, "FRU BDF FRUF", 'C'},
    {{"Sor", pentagon, kOrange}, "SOE", ' '},
    {{"Tag", pentagon, kYellow}, "T6T", ' '},
    {{"Psi", pentagon, kPink}, "PSV", ' '},
};

constexpr double kLongestRingBond = 2.0;  // Å

// The rings of pyranoses of aldoses and nonulosonates, and of furanoses of aldoses and ketoses.
constexpr std::array<std::array<std::string_view, 6>, 4> kSugarRings{{{"C1", "C2", "C3", "C4", "C5", "O5"},
                                                                      {"C2", "C3", "C4", "C5", "C6", "O6"},
                                                                      {"C2", "C3", "C4", "C5", "O5", ""},
                                                                      {"C1", "C2", "C3", "C4", "O4", ""}}};

bool is_listed(std::string_view names, std::string_view name) {
  for (std::size_t at = names.find(name); at != std::string_view::npos; at = names.find(name, at + 1))
    if ((at == 0 || names[at - 1] == ' ') && (at + name.size() == names.size() || names[at + name.size()] == ' '))
      return true;
  return false;
}

/// Returns the sugar of a name such as "4YB", "0fA" or "VMB". Returns null for any other name.
const Sugar* sugar_of_glycam(std::string_view name) {
  if (name.size() != 3 || std::string_view("ABUD").find(name[2]) == std::string_view::npos) return nullptr;
  if (std::string_view("0123456789ZYXWVUTSRQP").find(name[0]) == std::string_view::npos) return nullptr;
  for (const SugarRow& row : kSugars)
    if (row.glycam != ' ' && row.glycam == name[1]) return &row.sugar;
  return nullptr;
}

}  // namespace

SugarRing ring_of(std::span<const Atom> residue) {
  for (const auto& names : kSugarRings) {
    SugarRing ring;
    for (const std::string_view name : names) {
      if (name.empty()) break;
      const auto found = std::ranges::find(residue, name, &Atom::name);
      if (found == residue.end() || found->element == 0) break;
      ring.atoms[ring.count++] = static_cast<std::uint32_t>(found - residue.begin());
    }
    const std::uint32_t whole = names[5].empty() ? 5 : 6;
    bool closed = ring.count == whole;
    for (std::uint32_t n = 0; closed && n < whole; ++n) {
      const Atom &here = residue[ring.atoms[n]], &next = residue[ring.atoms[(n + 1) % whole]];
      closed = glm::distance(here.position, next.position) <= kLongestRingBond;
    }
    if (closed) return ring;
  }
  return {};
}

const Sugar* sugar_of(std::span<const Atom> residue) {
  const Atom& head = residue.front();
  if (head.kind == AtomClass::water || head.kind == AtomClass::ion || head.element == 0 || head.residue_name.size() < 3)
    return nullptr;
  for (const SugarRow& row : kSugars)
    if (is_listed(row.names, head.residue_name)) return &row.sugar;
  const Sugar* const found = sugar_of_glycam(head.residue_name);
  return found && ring_of(residue).count == 6 ? found : nullptr;
}

}  // namespace meniscus
