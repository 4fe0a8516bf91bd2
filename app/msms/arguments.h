// SPDX-License-Identifier: BSD-3-Clause
// The command line of MSMS: its options, their abbreviations and defaults.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus::msms {

/// The values of the options. Options without an effect here are accepted and ignored (help_text() lists them).
struct Arguments {
  bool help = false;
  std::string spheres;        ///< -if; empty: none
  std::string mesh_files;     ///< -of: .vert and .face are appended; empty: none
  std::string area_file;      ///< -af: .area is appended unless it is there; empty: none
  double probe_radius = 1.5;  ///< Å
  double density = 1.0;       ///< vertices per Å²
  double hdensity = 3.0;      ///< printed, but not used: a face has one density
  bool area = true;           ///< true if the analytic table is requested
  bool mesh = true;           ///< -surface tses; false: ases
  bool header = true;         ///< true for three lines above the rows of .vert and .face
  bool hydrogens = true;      ///< false: spheres of radius 1.2 are left out
  bool all_components = false;
  std::vector<std::uint32_t> cavity_atoms;  ///< -one_cavity: one to three sphere numbers from 0; empty: not set
  std::optional<std::uint16_t> port;        ///< -socketPort
};

/// True for radii within the limits of -probe_radius; the next function does the same for -density. NaN is rejected.
bool is_probe_radius(double radius);
bool is_density(double density);

/// Parses the words after the program's name. Blanks around a word are ignored. Throws UsageError for an unknown
/// option, a missing value, a value that is not a number in its range, and a word that belongs to no option.
Arguments parse_arguments(std::span<const char* const> words);

/// Returns the text that -h prints.
std::string help_text();

}  // namespace meniscus::msms
