// SPDX-License-Identifier: BSD-3-Clause
// Writes one molecule at several sets of positions as the models of a PDB file.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A PDB file with models of the same atoms. The file appears only when it is complete. Atoms of classes other than
/// polymer are written as HETATM.
class PdbModels {
 public:
  /// Begins a file. Throws RequestError if the format has no room for more than 99,999 atoms, residue numbers of more
  /// than four characters, or chains of more than two. Throws OutputError.
  PdbModels(const std::filesystem::path& path, Existing existing, std::span<const Atom> atoms);

  /// Adds a model with these positions (Å), in the order of the atoms. Throws RequestError for coordinates beyond
  /// -999.999 and 9999.999 Å.
  void add(std::span<const glm::dvec3> positions);
  /// Completes the file and gives it its name. Throws OutputError.
  void commit();

 private:
  std::span<const Atom> atoms_;
  OutputFile file_;
  int models_ = 0;
};

}  // namespace meniscus
