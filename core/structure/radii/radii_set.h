// SPDX-License-Identifier: BSD-3-Clause
// The built-in sets of van der Waals radii, each with its source.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meniscus {

struct Atom;

/// A radius and why an atom has it. The texts live as long as what gave them.
struct FoundRadius {
  double radius = 0.0;      ///< Å
  std::string_view label;   ///< the class: "C4H2", an element, a type of a force field
  std::string_view source;  ///< a paper, a file, an option
};

/// One published set.
struct RadiiSet {
  std::string_view name;  ///< as --radii takes it
  std::string_view description;
  std::string_view source;
  bool united;  ///< do the radii contain the hydrogens, which are then left out?
  /// Nothing for atoms that the set does not cover.
  std::optional<FoundRadius> (*radius_of)(const Atom& atom);
};

extern const RadiiSet kBondiSet;
extern const RadiiSet kUnitedSet;
extern const RadiiSet kProtorSet;
extern const RadiiSet kMartini2Set, kMartini3Set;

std::span<const RadiiSet* const> radii_sets();

/// The set of this name; nullptr: none.
const RadiiSet* find_radii_set(std::string_view name);

/// "bondi, united, protor, martini2, martini3, file".
std::string radii_set_names();

}  // namespace meniscus
