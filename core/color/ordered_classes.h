// SPDX-License-Identifier: BSD-3-Clause
// Classes of atoms with an order and colours of their own: secondary structure, confidence of predicted models, sugars,
// beads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_schemes.h"

namespace meniscus {

struct Structure;

/// A name and its colour.
struct ColorClass {
  std::string name;  ///< may come from a molecule file
  glm::vec3 color{0.0f};
  bool operator==(const ColorClass&) const = default;
};

/// The classes in their order, and of each atom which one it is in.
struct ClassedAtoms {
  std::vector<ColorClass> classes;
  std::vector<std::uint8_t> of_atom;  ///< one per Structure::atoms

  const glm::vec3& color(std::size_t atom) const { return classes[of_atom[atom]].color; }
};

inline constexpr std::string_view kWithoutConfidence = "none";

/// Helix, strand, coil, as secondary_structure() has them, and "other" for all that is no amino acid; those that occur.
ClassedAtoms secondary_classes(const Structure& structure);

/// The four classes of the AlphaFold database, all of them, by pLDDT above 90, 70 and 50; a number on a limit is in
/// the class below. After them kWithoutConfidence, if some atoms have no number. Throws InputError where none has one.
ClassedAtoms confidence_classes(const Structure& structure);

/// Each sugar that occurs by its symbol (core/structure/sugars.h). Of sugars whose symbol is half white, what is not in
/// the ring is in the class "white half"; what is no sugar in "other".
ClassedAtoms sugar_classes(const Structure& structure);

/// The classes of Martini's beads that occur: "charged", "polar", "intermediate", "apolar", "water"; "backbone" of
/// Martini 2, where it depends on the fold; "other" for what is no bead.
ClassedAtoms bead_classes(const Structure& structure);

/// Is this scheme one of these?
bool has_ordered_classes(ColorScheme::By by);
ClassedAtoms ordered_classes(const Structure& structure, ColorScheme::By by);

/// From where these have their numbers: "_ma_qa_metric_local" if any atom has an Atom::confidence, else "B-factors".
std::string_view source_of_confidence(const Structure& structure);

/// Why they may not be pLDDT, in one sentence: B-factors outside of 0 to 100, of an experiment, or from 0 to 1.
std::optional<std::string> doubt_of_confidence(const Structure& structure);

}  // namespace meniscus
