// SPDX-License-Identifier: BSD-3-Clause
// Spheres, cylinders and meshes of a scene, gathered by colour.
#pragma once

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/queries/colored_shapes.h"
#include "exporters/povray/palette.h"

namespace meniscus::povray {

/// Writes sphere, cylinder and mesh2 with their textures; a cylinder of two colours as its two halves. Names are ours,
/// all else numbers. origin: Å, of the scene's coordinates. Colours that `table` does not have yet are added. Throws
/// Error for a number that is not finite.
void write_shapes(OutputFile& file, const ColoredShapes& shapes, const glm::dvec3& origin, ColorTable& table,
                  const ObjectStyle& style = {});

/// Adds the colours of all shapes to the table.
void add_colors(const ColoredShapes& shapes, ColorTable& table, const ObjectStyle& style = {});

}  // namespace meniscus::povray
