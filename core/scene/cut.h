// SPDX-License-Identifier: BSD-3-Clause
// A plane that cuts what a picture shows, as a user writes it: in the molecule's coordinates, along the view, or by
// atoms that should be seen.
#pragma once

#include "core/camera/camera.h"
#include "core/math/ball.h"
#include "core/queries/surface_object.h"
#include "core/render/picture.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A cut by a plane. Points for which the expression holds are kept; a cut by atoms keeps the points farther from the
/// viewer than its plane.
struct Cut {
  /// The place of the plane. through: at the middle of the atoms; before: just deep enough for the atoms to be seen
  /// (open_depth).
  enum class Place { bound, through, before };

  glm::dvec3 direction{0.0};  ///< zero: along the view
  bool keeps_less = true;     ///< true: points with dot(direction, x) < bound are kept; false: points with more
  double bound = 0.0;         ///< Å; along the view, from 0 (the nearest atom) to 1 (the farthest)
  Place place = Place::bound;
  std::optional<Selection> atoms{};  ///< the atoms of a cut through or before atoms
};

/// Parses "x<20", "1,0.5,0>-3", "depth>0.5", "through ligand" or "before ligand"; blanks are ignored. Throws
/// RequestError, SelectionError.
Cut parse_cut(std::string_view text);

/// Returns the text from which parse_cut() reads exactly this cut.
std::string cut_text(const Cut& cut);

/// The balls of the atoms of each cut at all their places; none for a cut by a bound. The outer vector is empty if all
/// cuts are by bounds.
using CutAtoms = std::vector<std::vector<Ball>>;

/// Returns the atoms of each cut. structure: may have atoms that are drawn in addition to its surface; cuts may select
/// them too. Throws RequestError for a cut by atoms that selects none.
CutAtoms cut_atoms(std::span<const Cut> cuts, const Structure& structure);
/// True if there are cuts by atoms.
bool uses_atoms(std::span<const Cut> cuts);

/// The view and the atoms that place the planes of cuts.
struct CutView {
  const Camera& camera;
  std::span<const Ball> atoms;  ///< all atoms in the picture, at least one
  /// The shown atoms of the surface that is cut; they hide the atoms of a cut. Only cuts by atoms need them.
  std::span<const Ball> shown{};
};

/// Returns the planes of the cuts in a picture. cut_atoms: returned by cut_atoms() for the same cuts.
std::vector<ClipPlane> clip_planes(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view);
/// Returns the plane of a cut by a bound.
ClipPlane clip_plane(const Cut& cut, const Camera& camera, std::span<const Ball> atoms);

/// Returns the atoms of a surface with a visible part, for CutView::shown; for objects, in all their copies.
std::vector<Ball> shown_balls(std::span<const Ball> atoms, const Coloring& coloring);
std::vector<Ball> shown_balls(std::span<const SurfaceObject> objects);

/// Returns a sentence for each cut that removes nothing or all of a surface, and for each cut whose atoms stay partly
/// hidden. The sentence begins with the text of the cut. balls: the atoms of the surface with the radii of its kind, at
/// least one.
std::vector<std::string> ineffective_cuts(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view,
                                          std::span<const Ball> balls);

}  // namespace meniscus
