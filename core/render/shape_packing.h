// SPDX-License-Identifier: BSD-3-Clause
// Shapes packed for the ray caster, beside the patches of ray_cast_scene.h.
#pragma once

#include "core/render/ray_cast_scene.h"

namespace meniscus {

struct Shapes;

/// Spheres become convex patches without planes. Indices of atoms are those of the shapes; hidden ones are left out.
/// slack: patch_slack() of the picture.
void pack_shapes(const Shapes& shapes, const Coloring& coloring, const PictureFrame& frame, float slack,
                 RayCastScene& scene);

}  // namespace meniscus
