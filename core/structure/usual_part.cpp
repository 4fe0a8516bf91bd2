// SPDX-License-Identifier: BSD-3-Clause
// The parts that simulation programs write: without water, without ions, polymer only, without hydrogens.
#include "core/structure/usual_part.h"

#include <algorithm>
#include <utility>

namespace meniscus {

std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms) {
  using Belongs = bool (*)(const Atom&);
  const std::pair<const char*, Belongs> parts[] = {
      {"without water", [](const Atom& atom) { return atom.kind != AtomClass::water; }},
      {"without water and ions",
       [](const Atom& atom) { return atom.kind != AtomClass::water && atom.kind != AtomClass::ion; }},
      {"in polymers", [](const Atom& atom) { return atom.kind == AtomClass::polymer; }},
      {"without hydrogens", [](const Atom& atom) { return atom.element != 1; }}};
  for (const auto& [words, belongs] : parts) {
    if (static_cast<std::size_t>(std::ranges::count_if(atoms, belongs)) == frame_atoms)
      return std::string("as many as it has ") + words + "; give a FILE of these atoms only";
  }
  return "they do not belong together";
}

}  // namespace meniscus
