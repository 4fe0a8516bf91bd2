// SPDX-License-Identifier: BSD-3-Clause
// What every structure reader provides: a description of its format, a test for its content, and the atoms of a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/molecule/structure.h"
#include "core/molecule/text_file.h"

namespace meniscus {

/// What a format is, in words users can look up.
struct FormatMetadata {
  std::string_view name;
  std::string_view extensions;  ///< ".pdb .ent", blank-separated
  std::string_view description;
  std::string_view reference;
  std::string_view reads;  ///< which records or columns are used
};

/// The atoms of a file's first model in file order, residues in one piece. Positions are finite.
struct FileContents {
  std::vector<Atom> atoms;  ///< as they stand in the file, nothing left out
  std::size_t models = 1;
  std::size_t other_model_atoms = 0;
  bool radii_from_file = false;
  std::vector<std::string> warnings;
};

/// One format. `recognizes` looks at content only; `read` throws InputError with file and line. `assemblies` is null
/// for formats that describe none.
struct Reader {
  FormatMetadata metadata;
  bool (*recognizes)(std::string_view text);
  FileContents (*read)(const TextFile& file);
  std::vector<Assembly> (*assemblies)(const TextFile& file) = nullptr;
};

extern const Reader kPdbReader;
extern const Reader kMmcifReader;
extern const Reader kXyzrReader;

/// Largest coordinate in Å that readers accept (10 µm); beyond it the file is broken or in other units.
inline constexpr double kLargestCoordinate = 1e5;

/// Parses a coordinate field; throws InputError naming file, line, axis and text unless finite and within bounds.
double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field);

/// Parses all of `field`, blanks around it aside, as a finite number; false if it is none.
bool parse_number(std::string_view field, double& number);

}  // namespace meniscus
