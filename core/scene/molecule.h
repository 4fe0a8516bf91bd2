// SPDX-License-Identifier: BSD-3-Clause
// A molecule with its surfaces and colours, made from a file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/color/color_schemes.h"
#include "core/queries/surface_object.h"
#include "core/scene/open_book.h"
#include "core/scene/surface_computer.h"
#include "core/scene/surface_objects.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Which atoms, which surfaces of them, which colours.
struct MoleculeRequest {
  std::string file;  ///< "-": standard input
  ReadOptions reading;
  std::optional<Selection> show;  ///< of the atoms taken, those whose part of the surface is drawn and exported
  SurfaceRequest surface;
  Division division;
  ColorScheme color;
  bool color_named = false;                   ///< whether someone asked for the scheme of all atoms
  std::optional<InterfaceRequest> interface;  ///< opened like a book
  std::optional<Selection> patches;           ///< atoms whose contiguous areas are listed, and outlined in pictures
  double least_patch = 10.0;                  ///< Å²: smaller ones are left out
  std::string number_file;                    ///< numbers to colour by, for ColorScheme::By::file
  std::string number_column;                  ///< of a number file that is a table
  std::string volume_file;                    ///< a volume map to colour by, for ColorScheme::By::volume
  double volume_offset = 0.0;                 ///< Å outside of the surface where it is sampled
  std::string map_file;                       ///< a colour map of the user's own; empty: none
};

/// A molecule, ready to be drawn or exported.
struct Molecule {
  Structure structure;
  ColorScheme color;                   ///< as asked for, with the numbers of its file
  std::vector<SurfaceObject> objects;  ///< at least one
  double beyond_map = 0.0;             ///< share of the surface, in [0, 1), that its volume map does not reach
  std::string device;                  ///< what computed them
  std::vector<StageTime> stages;       ///< of all of them

  const Surface& surface() const { return objects.front().surface; }
  const Coloring& coloring() const { return objects.front().coloring; }
};

/// The atoms asked for; Structure::report says what was read and left out. Throws InputError, RequestError.
Structure read_molecule(const MoleculeRequest& request);

/// The same for structures of its atoms wherever they are.
std::unique_ptr<StructureFile> open_molecule(const MoleculeRequest& request);

/// The colour scheme with the numbers of its file, if it has one. Throws InputError.
ColorScheme color_of(const MoleculeRequest& request);

/// Per atom, whether it is of these patches. Throws RequestError if none is.
std::vector<bool> patch_atoms(const Selection& patches, const std::vector<Atom>& atoms);

/// What groups of atoms bury of each other.
struct Burial {
  std::vector<AtomGroup> groups;  ///< the sides of the interface, else those of the division, else chains
  std::vector<double> areas;      ///< buried_areas(), of each atom
};

/// Of a structure, in which an interface is closed. Throws what buried_areas and interface_groups throw, RequestError
/// for copies as instances.
Burial burial_of(const MoleculeRequest& request, const Structure& structure, SurfaceComputer& computer);

/// Throws RequestError for colours by copy where copies share one surface.
void require_colors_shared(const Structure& structure, const ColorScheme& color);

/// Makes molecules of one structure after another: the frames of a trajectory.
class MoleculeBuilder {
 public:
  /// `request` must live as long, and so must `context`, if surfaces on GL should be made in it. Throws InputError for
  /// the numbers to colour by, RequestError.
  explicit MoleculeBuilder(const MoleculeRequest& request, const EglContext* context = nullptr);

  /// Computes and colours. Throws what surface_objects and color_object throw, InputError if nothing is shown or no
  /// point of the surface lies in its volume map.
  Molecule build(Structure structure);

  /// Whether it computes on the CPU alone: then it may be used on any thread, by one at a time.
  bool is_on_cpu() const { return computer_.is_on_cpu(); }

  /// The greatest share of a surface built so far that its volume map does not reach.
  double most_beyond_map() const { return most_beyond_map_; }

  /// For further surfaces on the same device.
  SurfaceComputer& computer() { return computer_; }

 private:
  void measure_burial(Molecule& molecule);

  const MoleculeRequest& request_;
  ColorScheme color_;
  Division division_;
  SurfaceComputer computer_;
  double most_beyond_map_ = 0.0;
};

}  // namespace meniscus
