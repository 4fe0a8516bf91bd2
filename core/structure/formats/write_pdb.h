// SPDX-License-Identifier: BSD-3-Clause
// Writes one molecule at several places as the models of a PDB file.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The file is complete or not there at all. Atoms of classes other than polymer are HETATM.
class PdbModels {
 public:
  /// Throws RequestError for atoms that the format has no room for: more than 99,999 of them, numbers of residues of
  /// more than four characters, chains of more than two; OutputError.
  PdbModels(const std::filesystem::path& path, Existing existing, std::span<const Atom> atoms);

  /// The next model: positions of the atoms, Å, in their order. Throws RequestError beyond -999.999 and 9999.999 Å.
  void add(std::span<const glm::dvec3> positions);
  void commit();

 private:
  std::span<const Atom> atoms_;
  OutputFile file_;
  int models_ = 0;
};

}  // namespace meniscus
