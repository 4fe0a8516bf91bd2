// SPDX-License-Identifier: BSD-3-Clause
// ProtOr radii of J. Tsai, R. Taylor, C. Chothia & M. Gerstein, J. Mol. Biol. 290, 253 (1999), by bonding class.
#include <map>

#include "core/structure/bonding_classes.h"
#include "core/structure/radii/radii_set.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr const char* kPaper = "Tsai et al. 1999, J. Mol. Biol. 290, 253";
constexpr const char* kExtension = "FreeSASA's extension of Tsai et al. 1999";

struct Entry {
  double radius;  // Å
  const char* source;
};

// The paper covers proteins; S. Mitternacht, F1000Research 5, 189 (2016) adds nucleotides, selenium and water.
const std::map<std::string_view, Entry> kRadii{
    {"C3H0", {1.61, kPaper}},     {"C3H1", {1.76, kPaper}},      {"C4H1", {1.88, kPaper}},
    {"C4H2", {1.88, kPaper}},     {"C4H3", {1.88, kPaper}},      {"N3H0", {1.64, kPaper}},
    {"N3H1", {1.64, kPaper}},     {"N3H2", {1.64, kPaper}},      {"N4H3", {1.64, kPaper}},
    {"O1H0", {1.42, kPaper}},     {"O2H1", {1.46, kPaper}},      {"S2H0", {1.77, kPaper}},
    {"S2H1", {1.77, kPaper}},     {"P4H0", {1.80, kExtension}},  {"O2H0", {1.46, kExtension}},
    {"O2H2", {1.46, kExtension}}, {"SE2H1", {1.90, kExtension}}, {"SE2H0", {1.90, kExtension}},
    {"N2H0", {1.64, kExtension}}};

std::optional<FoundRadius> radius_of(const Atom& atom) {
  const auto found = kRadii.find(bonding_class(atom.residue_name, atom.name));
  if (found == kRadii.end()) return std::nullopt;
  return FoundRadius{found->second.radius, found->first, found->second.source};
}

}  // namespace

const RadiiSet kProtorSet{"protor", "united atoms by bonding class, as FreeSASA uses them", kPaper, true, radius_of};

}  // namespace meniscus
