// SPDX-License-Identifier: BSD-3-Clause
// Checks that scenes of one surface and of a run make before and after they are written: names, extents, notes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/math/box.h"
#include "exporters/povray/geometry.h"
#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// Of all atoms and copies.
Box atom_extent(std::span<const SurfaceObject> objects);

/// Å, to three decimals.
glm::dvec3 middle(const Box& extent);

/// Throws Error: a name that cannot be in a scene, no pixels, no atom.
void check(std::span<const SurfaceObject> objects, const SceneOptions& options);

/// Sentences: what the picture lacks, what will be slow.
std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera);

}  // namespace meniscus::povray
