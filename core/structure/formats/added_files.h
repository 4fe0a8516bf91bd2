// SPDX-License-Identifier: BSD-3-Clause
// Molecule files that are added to another, each as a further model of it, where they are or superposed on it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/structure/formats/structure_formats.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/structure/superposition.h"

namespace meniscus {

/// The atoms of further files, which come after those of the first one.
class AddedFiles {
 public:
  /// Reads the files and appends their atoms and bonds to `contents`: the first model of each, or all of them if those
  /// of the first file are, numbered on after the models that are there. superpose_on: atoms by which each file is
  /// superposed on the first, with atoms of it that the same expression selects (corresponding_atoms); nothing: it
  /// stays where it is. path: of the first file. Throws InputError: what the readers throw, files without positions,
  /// files of which one has radii and the other has none, files without a chain that corresponds.
  AddedFiles(const std::string& path, std::span<const std::string> files, const ModelChoice& models,
             const std::optional<Selection>& superpose_on, FileContents& contents);

  /// Superposes the files again, where those of the first have moved. atoms: as the constructor has left them, with
  /// other positions. One each: what was added, with its fit.
  std::vector<AddedFile> place(std::vector<Atom>& atoms) const;

 private:
  struct Part {
    AddedFile file;
    std::size_t begin = 0, end = 0;  ///< of its atoms
    std::vector<AtomPair> pairs;     ///< empty: it stays where it is
  };

  std::vector<Part> parts_;
};

}  // namespace meniscus
