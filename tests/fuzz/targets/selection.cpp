// SPDX-License-Identifier: BSD-3-Clause
// Selections are understood or refused with a caret, and obey the laws of sets.
#include <algorithm>
#include <optional>

#include "core/base/error.h"
#include "core/structure/radii/assign_radii.h"
#include "core/structure/selection/selection.h"
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

std::optional<Selection> parsed(std::string_view text) {
  try {
    return parse_selection(text);
  } catch (const SelectionError& error) {
    require_clear(error);
    const std::string& picture = error.picture();
    require(std::ranges::count(picture, '\n') == 1 && picture.ends_with('^'), "a caret stands under the place");
    return std::nullopt;
  }
}

/// Returns the atoms that a longer expression selects; nothing if it is too long or too deep.
std::optional<std::vector<bool>> selected(const std::string& text, const std::vector<Atom>& atoms) {
  const std::optional<Selection> selection = parsed(text);
  return selection ? std::optional(selection->evaluate(atoms)) : std::nullopt;
}

void check_laws(const std::string& text, const std::vector<Atom>& atoms, const std::vector<bool>& set) {
  std::vector<bool> others = set;
  others.flip();
  const auto complement = selected("not (" + text + ")", atoms);
  require(!complement || *complement == others, "what is not selected is selected by not");
  const auto both = selected("(" + text + ") and not (" + text + ")", atoms);
  require(!both || std::ranges::find(*both, true) == both->end(), "nothing is in a set and not in it");
  const auto twice = selected("(" + text + ") or (" + text + ")", atoms);
  require(!twice || *twice == set, "a set or itself is the set");
}

void run_selection(std::string_view bytes) {
  const std::string text(bytes);
  if (const std::optional<Selection> selection = parsed(text)) {
    const std::vector<Atom> atoms = sample_atoms();
    const std::vector<bool> set = selection->evaluate(atoms);
    require(set.size() == atoms.size() && selection->names(atoms).size() == atoms.size(), "one truth value an atom");
    require(selection->evaluate(std::span<const Atom>{}).empty(), "no atoms, no values");
    require(selection->text() == text, "a selection keeps its text");
    check_laws(text, atoms, set);
  }
  try {
    require(parse_radius_override(text).radius > 0.0, "a radius that overrides is above 0");
  } catch (const SelectionError& error) {
    require_clear(error);
  }
}

const Registration registered_selection{"selection", run_selection};

}  // namespace
}  // namespace meniscus::fuzz
