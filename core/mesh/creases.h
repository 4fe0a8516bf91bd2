// SPDX-License-Identifier: BSD-3-Clause
// Borders at which faces meet at an angle, and which of them a mesh of given edges has to follow.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// The unit normals at a point of a border on both sides of it: of a cusp between spheres of two probes, and, where the
/// probe has no size, of two balls. Twice the same (0) for other borders: tangent planes agree there.
std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x);

/// The angle (radian) between them, the same all along the border.
double crease_angle(const Surface& surface, const Border& border);

/// Per border whether triangles with edges this long (Å, at a place) should end at it: those that bridge it would be
/// farther from the surface than elsewhere (h sin(angle/2) / 4 against h²/(6 r)), and the crease is no shorter than an
/// edge.
std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge);

}  // namespace meniscus
