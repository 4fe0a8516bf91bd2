// SPDX-License-Identifier: BSD-3-Clause
// Classes of atoms with an order and colours of their own: secondary structure, confidence of predicted models, sugars,
// beads.
#pragma once

#include "core/color/color_schemes.h"

namespace meniscus {

struct Structure;

struct ColorClass {
  std::string name;  ///< may come from a molecule file
  glm::vec3 color{0.0f};
  bool operator==(const ColorClass&) const = default;
};

/// The classes in their order, and the class of each atom.
struct ClassedAtoms {
  std::vector<ColorClass> classes;
  std::vector<std::uint8_t> of_atom;  ///< one per Structure::atoms

  const glm::vec3& color(std::size_t atom) const { return classes[of_atom[atom]].color; }
};

inline constexpr std::string_view kWithoutConfidence = "none";

/// Returns helix, strand and coil, as in secondary_structure(), and "other" for atoms outside amino acids; only classes
/// that occur.
ClassedAtoms secondary_classes(const Structure& structure);

/// Returns the four classes of the AlphaFold database, all of them, by pLDDT above 90, 70 and 50; a number on a limit
/// is in the class below. kWithoutConfidence follows if some atoms have no number. Throws InputError if no atom has
/// one.
ClassedAtoms confidence_classes(const Structure& structure);

/// True if this scheme has one of these lists of classes.
bool has_ordered_classes(ColorScheme::By by);
ClassedAtoms ordered_classes(const Structure& structure, ColorScheme::By by);

/// Returns the source of pLDDT: "_ma_qa_metric_local" if any atom has an Atom::confidence, else "B-factors".
std::string_view source_of_confidence(const Structure& structure);

/// Returns a sentence that says why the numbers may not be pLDDT: B-factors outside of 0 to 100, of an experiment, or
/// from 0 to 1. Nothing if there is no doubt.
std::optional<std::string> doubt_of_confidence(const Structure& structure);

}  // namespace meniscus
