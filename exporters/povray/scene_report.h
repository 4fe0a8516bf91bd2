// SPDX-License-Identifier: BSD-3-Clause
// Checks for scenes of one surface and of a run, before and after they are written: names, extents, notes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/math/box.h"
#include "exporters/povray/povray_options.h"
#include "exporters/povray/surface_pieces.h"

namespace meniscus::povray {

/// Returns the box of all atoms in all copies.
Box atom_extent(std::span<const SurfaceObject> objects);

/// Returns the centre of a box in Å, rounded to three decimals.
glm::dvec3 middle(const Box& extent);

/// Throws Error if the name of the scene is invalid, the picture has no pixels, or an object has no atom.
void check(std::span<const SurfaceObject> objects, const SceneOptions& options);

/// Returns sentences about atoms that are cut off, patches that are left out, and large memory use of POV-Ray.
std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera);

}  // namespace meniscus::povray
