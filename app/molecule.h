// SPDX-License-Identifier: BSD-3-Clause
// The one way from a command's options to a molecule with its surfaces and colours.
#pragma once

#include <string>
#include <vector>

#include "app/options/molecule_options.h"
#include "core/base/stage_clock.h"
#include "core/color/color_scale.h"
#include "core/structure/structure.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// A molecule, ready to be drawn or exported.
struct Molecule {
  Structure structure;
  ColorScheme color;                   ///< as asked for, with the numbers of --color-by-file
  std::vector<SurfaceObject> objects;  ///< at least one
  std::string device;                  ///< what computed them
  std::vector<StageTime> stages;       ///< of all of them

  const Surface& surface() const { return objects.front().surface; }
  const Coloring& coloring() const { return objects.front().coloring; }
};

/// Reads the file and says on stderr, unless quiet, what was read and left out, and each warning. With --assembly list
/// it prints the assemblies and ends the program by CLI::Success.
Structure read_molecule(const MoleculeOptions& options);

/// The colour scheme with the numbers of its file, if it has one. Throws InputError.
ColorScheme color_of(const MoleculeOptions& options);

/// What the colours of its objects mean.
ColorKey key_of(const Molecule& molecule);

/// The same as a JSON object: title, and unit, map, range, missing, missing_color or classes.
std::string colors_json(const ColorKey& key);
std::string colors_json(const Molecule& molecule);

/// A table of the assemblies the file describes, on stdout.
void print_assemblies(const Structure& structure);

/// Makes molecules of one structure after another: the frames of a trajectory.
class MoleculeBuilder {
 public:
  /// `options` must live as long, and so must `context`, if surfaces on GL shall be made in it. Throws InputError for
  /// the numbers of --color-by-file, RequestError.
  explicit MoleculeBuilder(const MoleculeOptions& options, const EglContext* context = nullptr);

  /// Computes and colours. Throws what surface_objects and color_object throw, InputError if --show shows nothing.
  Molecule build(Structure structure);

 private:
  const MoleculeOptions& options_;
  ColorScheme color_;
  DivisionOptions division_;
  SurfaceComputer computer_;
};

/// Reads, computes and colours, in that order; says on stderr what was read and on which device it ran.
Molecule load_molecule(const MoleculeOptions& options);

}  // namespace meniscus
