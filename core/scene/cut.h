// SPDX-License-Identifier: BSD-3-Clause
// A plane that cuts what a picture shows, as a user writes it: in the molecule's coordinates, or along the view.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/math/ball.h"
#include "core/render/picture_object.h"

namespace meniscus {

/// Kept is where the expression holds.
struct Cut {
  glm::dvec3 direction{0.0};  ///< 0: along the view
  bool keeps_less = true;     ///< points with dot(direction, x) < bound, else with more
  double bound = 0.0;         ///< Å; along the view from 0 (the nearest atom) to 1 (the farthest)
};

/// "x<20", "1,0.5,0>-3" or "depth>0.5"; blanks do not count. Throws RequestError.
Cut parse_cut(std::string_view text);

/// What parse_cut reads as this cut, exactly.
std::string cut_text(const Cut& cut);

/// The plane in a picture of these atoms. There must be an atom.
ClipPlane clip_plane(const Cut& cut, const Camera& camera, std::span<const Ball> atoms);
std::vector<ClipPlane> clip_planes(std::span<const Cut> cuts, const Camera& camera, std::span<const Ball> atoms);

/// A sentence for each cut that takes away nothing of a surface, or all of it; it begins with the cut as text. atoms:
/// as for clip_plane(); balls: those of the surface, with the radii of its kind. There must be a ball.
std::vector<std::string> idle_cuts(std::span<const Cut> cuts, const Camera& camera, std::span<const Ball> atoms,
                                   std::span<const Ball> balls);

}  // namespace meniscus
