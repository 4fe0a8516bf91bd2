// SPDX-License-Identifier: BSD-3-Clause
// The built-in sets of van der Waals radii, with their sources.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meniscus {

struct Atom;

/// A radius and its origin. The texts live as long as the table or set that they come from.
struct FoundRadius {
  double radius = 0.0;      ///< Å
  std::string_view label;   ///< class: "C4H2", an element, or a type of a force field
  std::string_view source;  ///< paper, file or option
};

/// A published set of radii.
struct RadiiSet {
  std::string_view name;  ///< name for --radii
  std::string_view description;
  std::string_view source;
  bool united;  ///< true if the radii include hydrogens, which are then left out
  /// Returns the radius of an atom; nothing if the set does not cover it.
  std::optional<FoundRadius> (*radius_of)(const Atom& atom);
};

extern const RadiiSet kBondiSet;
extern const RadiiSet kUnitedSet;
extern const RadiiSet kProtorSet;
extern const RadiiSet kMartini2Set, kMartini3Set;

/// Returns all built-in sets.
std::span<const RadiiSet* const> radii_sets();

/// Returns the set with this name; null if there is none.
const RadiiSet* find_radii_set(std::string_view name);

/// Returns "bondi, united, protor, martini2, martini3, file".
std::string radii_set_names();

}  // namespace meniscus
