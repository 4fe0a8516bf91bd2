// SPDX-License-Identifier: BSD-3-Clause
// Says in words what happened to the atoms of a file.
#include "core/structure/structure.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

constexpr std::pair<const char*, const char*> kReasonWords[] = {
    {kExcludedModel, "of other models"},
    {kExcludedTrajectory, "not in the trajectory"},
    {kExcludedAltloc, "of other alternate locations"},
    {kExcludedVirtual, "virtual sites"},
    {kExcludedSelection, "not selected"},
    {kExcludedElement, "of unknown element"},
    {kExcludedRadius, "of radius zero"},
    {kExcludedHydrogen, "hydrogen"},
    {kExcludedWater, "water"},
    {kExcludedIon, "free ion"},
    {kExcludedAssembly, "outside the assembly"},
};

}  // namespace

const char* class_name(AtomClass kind) {
  switch (kind) {
    case AtomClass::polymer:
      return "polymer";
    case AtomClass::ligand:
      return "ligand";
    case AtomClass::water:
      return "water";
    case AtomClass::ion:
      return "ion";
    case AtomClass::unclassified:
      break;
  }
  return "unclassified";
}

std::string label_of(const Atom& atom) {
  if (atom.residue_name.empty()) return fmt::format("{} (atom {})", in_quotes(atom.name), atom.index + 1);
  return fmt::format("{} in {} {}{}{}", in_quotes(atom.name), atom.residue_name, atom.chain, atom.residue_number,
                     atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code));
}

std::string reasons_text(const std::map<std::string, std::size_t>& excluded) {
  std::string text;
  for (const auto& [reason, words] : kReasonWords) {
    const auto found = excluded.find(reason);
    if (found == excluded.end()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", with_thousands(found->second), words);
  }
  return text;
}

std::string ReadReport::sentence() const {
  const std::string left_out = reasons_text(excluded);
  return fmt::format("{} {} read; {} left out; {} used{}{}", with_thousands(read), read == 1 ? "atom" : "atoms",
                     left_out.empty() ? "none" : left_out, with_thousands(used), assembled.empty() ? "" : "; ",
                     assembled);
}

std::vector<Ball> balls_of(const Structure& structure) {
  std::vector<Ball> balls;
  balls.reserve(structure.atoms.size());
  for (const Atom& atom : structure.atoms) balls.push_back({atom.position, atom.radius});
  return balls;
}

}  // namespace meniscus
