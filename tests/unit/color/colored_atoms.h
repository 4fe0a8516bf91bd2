// SPDX-License-Identifier: BSD-3-Clause
// Four atoms of two chains, and common functions for the tests of colours.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "core/structure/structure.h"

namespace meniscus {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline Structure four_atoms() {
  Structure structure;
  structure.file = "four";
  const char* chains[] = {"A", "A", "B", "A"};
  const char* residues[] = {"ASP", "LYS", "GLY", "UNX"};
  const float b_factors[] = {10.0f, 20.0f, 30.0f, kNan};
  const float charges[] = {-0.25f, 0.5f, kNan, 0.0f};
  for (std::uint32_t n = 0; n < 4; ++n) {
    Atom& atom = structure.atoms.emplace_back();
    atom.index = n;
    atom.chain = chains[n];
    atom.residue_name = residues[n];
    atom.b_factor = b_factors[n];
    atom.charge = charges[n];
    atom.occupancy = 1.0f;
    atom.element = static_cast<std::uint8_t>(6 + n % 3);
  }
  structure.report.read = 4;
  structure.report.used = 4;
  return structure;
}

inline ColorScheme scheme(const char* word) { return parse_color_scheme(word).value(); }

inline Coloring colored(const char* word, const Structure& structure = four_atoms()) {
  return color_atoms(structure, scheme(word));
}

/// Returns the message of an error in `run`.
template <class Run>
std::string complaint(const Run& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace meniscus
