// SPDX-License-Identifier: BSD-3-Clause
// Colours of the points of a surface by a volume map, such as an electrostatic potential.
#pragma once

#include <glm/vec3.hpp>

#include "core/color/color_scale.h"
#include "core/volume/volume_grid.h"

namespace meniscus {

/// The map, where it is sampled, and what colours its values have.
struct VolumePaint {
  VolumeGrid grid;
  ColorScale scale;     ///< without numbers of atoms
  double offset = 0.0;  ///< Å outside of the surface, along its normal

  /// NaN where the map does not reach. point: Å; normal: of length 1, towards the solvent.
  double value(const glm::dvec3& point, const glm::dvec3& normal) const { return grid.sample(point + offset * normal); }
  /// sRGB.
  glm::vec3 color(const glm::dvec3& point, const glm::dvec3& normal) const { return scale.color(value(point, normal)); }
};

}  // namespace meniscus
