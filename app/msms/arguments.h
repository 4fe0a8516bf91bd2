// SPDX-License-Identifier: BSD-3-Clause
// The command line of MSMS: its options, their abbreviations and defaults.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus::msms {

/// What is asked for. Options that change nothing here are read and forgotten (help_text() names them).
struct Arguments {
  bool help = false;
  std::string spheres;        ///< -if; empty: none
  std::string mesh_files;     ///< -of: .vert and .face are appended; empty: none
  std::string area_file;      ///< -af: .area is appended unless it is there; empty: none
  double probe_radius = 1.5;  ///< Å
  double density = 1.0;       ///< vertices per Å²
  double hdensity = 3.0;      ///< told, not used: a face has one density
  bool area = true;           ///< the analytic table
  bool mesh = true;           ///< -surface tses; false: ases
  bool header = true;         ///< three lines above the rows of .vert and .face
  bool hydrogens = true;      ///< false: spheres of radius 1.2 are left out
  bool all_components = false;
  std::vector<std::uint32_t> cavity_atoms;  ///< -one_cavity: one to three sphere numbers from 0; empty: not asked
  std::optional<std::uint16_t> port;        ///< -socketPort
};

/// Within the limits of -probe_radius and -density; a number that is none is not.
bool is_probe_radius(double radius);
bool is_density(double density);

/// words: without the program's name. Blanks around each are nothing. Throws UsageError: no such option, a value that
/// is missing or no number in its range, a word that belongs to no option.
Arguments parse_arguments(std::span<const char* const> words);

/// What -h says.
std::string help_text();

}  // namespace meniscus::msms
