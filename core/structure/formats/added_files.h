// SPDX-License-Identifier: BSD-3-Clause
// Molecule files that are added to another file as further models, at their positions or superposed on it.
#pragma once

#include "core/structure/formats/structure_formats.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/structure/superposition.h"

namespace meniscus {

/// The atoms of added files, which follow the atoms of the first file.
class AddedFiles {
 public:
  /// Reads the files and appends their atoms and bonds to `contents`. The first model of each file is used, or all
  /// models if models.all is set. The models are numbered on from the models before. superpose_on: the atoms by which
  /// each file is superposed on the first, selected by this expression in both files (corresponding_atoms); none: the
  /// file keeps its positions. path: the first file, for messages. Throws InputError as the readers do, and for files
  /// without positions, files of which only some have radii, and files with no corresponding chain.
  AddedFiles(const std::string& path, std::span<const std::string> files, const ModelChoice& models,
             const std::optional<Selection>& superpose_on, FileContents& contents);

  /// Superposes the files again after atoms of the first file have moved. atoms: the atoms after the constructor, with
  /// other positions. Returns one entry for each file, with its superposition.
  std::vector<AddedFile> place(std::vector<Atom>& atoms) const;

 private:
  struct Part {
    AddedFile file;
    std::size_t begin = 0, end = 0;  ///< range of its atoms
    std::vector<AtomPair> pairs;     ///< pairs for the superposition; empty if the file keeps its positions
  };

  std::vector<Part> parts_;
};

}  // namespace meniscus
