// SPDX-License-Identifier: BSD-3-Clause
// Colours that callers pass: one for all atoms, or one for each.
#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

#include "core/color/coloring.h"
#include "exporters/bindings/c/caller_memory.h"

namespace meniscus::c_api {

/// sRGB of a surface or mesh to which nobody gave a colour.
inline constexpr glm::vec3 kPlainColor(0.75f, 0.82f, 0.9f);

inline void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    refuse(MENISCUS_INPUT, "{} is {}; it has to be {} to {}", name, value, low, high);
}

/// color: of atoms if of_atoms, three numbers an atom, is NULL. Channels are in [0, 1], else MENISCUS_INPUT.
inline Coloring coloring_of(const glm::vec3& color, const float* of_atoms, std::size_t atoms) {
  for (int n = 0; n < 3; ++n) check_range("color", color[n], 0, 1);
  Coloring coloring;
  coloring.atom.assign(atoms, color);
  if (!of_atoms) return coloring;
  require_numbers(of_atoms, atoms, 3, "atom_colors");
  for (std::size_t n = 0; n < 3 * atoms; ++n) {
    const float channel = of_atoms[n];
    if (!(channel >= 0.0f && channel <= 1.0f))
      refuse(MENISCUS_INPUT, "channel {} of the colour of atom {} is {}; it has to be 0 to 1", n % 3, n / 3, channel);
    coloring.atom[n / 3][static_cast<int>(n % 3)] = channel;
  }
  return coloring;
}

}  // namespace meniscus::c_api
