// SPDX-License-Identifier: BSD-3-Clause
// A plane that cuts what a picture shows, as a user writes it: in the molecule's coordinates, along the view, or by
// atoms that should be seen.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/math/ball.h"
#include "core/queries/surface_object.h"
#include "core/render/picture.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Kept is where the expression holds; by atoms, what is farther from the viewer.
struct Cut {
  /// through: their middle; before: as deep as it must be for them to be seen (open_depth).
  enum class Place { bound, through, before };

  glm::dvec3 direction{0.0};  ///< 0: along the view
  bool keeps_less = true;     ///< points with dot(direction, x) < bound, else with more
  double bound = 0.0;         ///< Å; along the view from 0 (the nearest atom) to 1 (the farthest)
  Place place = Place::bound;
  std::optional<Selection> atoms{};  ///< of through and before
};

/// "x<20", "1,0.5,0>-3", "depth>0.5", "through ligand" or "before ligand"; blanks do not count. Throws RequestError,
/// SelectionError.
Cut parse_cut(std::string_view text);

/// What parse_cut reads as this cut, exactly.
std::string cut_text(const Cut& cut);

/// The atoms of each cut, wherever they stand; none of a cut by a bound. Empty where all cuts are by bounds.
using CutAtoms = std::vector<std::vector<Ball>>;

/// structure: with the atoms beside its surface, which may be chosen, too. Throws RequestError for a cut by atoms that
/// selects none.
CutAtoms cut_atoms(std::span<const Cut> cuts, const Structure& structure);
/// Whether there are cuts by atoms.
bool uses_atoms(std::span<const Cut> cuts);

/// What planes are placed by.
struct CutView {
  const Camera& camera;
  std::span<const Ball> atoms;  ///< of all that the picture shows; there must be one
  /// Of the surface that is cut, those that are shown: what hides the atoms of a cut. Only cuts by atoms need it.
  std::span<const Ball> shown{};
};

/// The planes in a picture. cut_atoms: of these cuts.
std::vector<ClipPlane> clip_planes(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view);
/// That of a cut by a bound.
ClipPlane clip_plane(const Cut& cut, const Camera& camera, std::span<const Ball> atoms);

/// The atoms of a surface of which anything is shown, for CutView::shown; of objects in all their copies.
std::vector<Ball> shown_balls(std::span<const Ball> atoms, const Coloring& coloring);
std::vector<Ball> shown_balls(std::span<const SurfaceObject> objects);

/// A sentence for each cut that takes away nothing of a surface, or all of it, and for each by whose atoms less is seen
/// than there should; it begins with the cut as text. balls: those of the surface, with the radii of its kind. There
/// must be a ball.
std::vector<std::string> idle_cuts(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view,
                                   std::span<const Ball> balls);

}  // namespace meniscus
