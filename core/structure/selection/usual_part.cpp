// SPDX-License-Identifier: BSD-3-Clause
// The parts that simulation programs write: without water, without ions, polymer or protein only, without hydrogens.
#include "core/structure/selection/usual_part.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/structure/selection/selection.h"

namespace meniscus {

std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms) {
  struct Part {
    const char *words, *selection;
  };
  constexpr Part kParts[] = {{"without water", "not water"},
                             {"without water and ions", "not (water or ion)"},
                             {"in polymers", "polymer"},
                             {"in proteins", "protein"},
                             {"without hydrogens", "not hydrogen"},
                             {"in polymers without hydrogens", "polymer and not hydrogen"},
                             {"named CA", "name CA"}};
  for (const Part& part : kParts) {
    const std::vector<bool> selected = parse_selection(part.selection).evaluate(atoms);
    if (static_cast<std::size_t>(std::ranges::count(selected, true)) == frame_atoms)
      return fmt::format("as many as it has {}: choose --trajectory-atoms '{}'", part.words, part.selection);
  }
  return "they do not belong together; if the trajectory has a part of these atoms, name it by --trajectory-atoms";
}

}  // namespace meniscus
