// SPDX-License-Identifier: BSD-3-Clause
// Writes spheres, cylinders and meshes of a scene, grouped by colour.
#pragma once

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/queries/colored_shapes.h"
#include "exporters/povray/scene_colors.h"

namespace meniscus::povray {

/// Writes shapes as sphere, cylinder and mesh2 objects with textures. A cylinder of two colours becomes two halves. The
/// text consists of names chosen by this program and of numbers only. origin: the origin of the scene's coordinates, in
/// Å. Colours that `table` does not have yet are added. Throws Error for a number that is not finite.
void write_shapes(OutputFile& file, const ColoredShapes& shapes, const glm::dvec3& origin, ColorTable& table,
                  const ObjectStyle& style = {});

/// Adds the colours of all shapes to the table.
void add_colors(const ColoredShapes& shapes, ColorTable& table, const ObjectStyle& style = {});

}  // namespace meniscus::povray
