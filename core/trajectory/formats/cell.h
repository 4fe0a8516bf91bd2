// SPDX-License-Identifier: BSD-3-Clause
// Periodic boxes as trajectory formats write them, as vectors.
#pragma once

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

/// The box of edges a, b, c (Å) and cosines of alpha, beta, gamma, with a along x and b in the plane of x and y (the
/// usual convention of crystallography). None if it is no box: edges not positive, angles that do not fit together.
std::optional<glm::dmat3> cell_of_cosines(const glm::dvec3& edges, const glm::dvec3& cosines);

/// The same from angles in degrees; right angles give exactly rectangular boxes.
std::optional<glm::dmat3> cell_of_angles(const glm::dvec3& edges, const glm::dvec3& degrees);

/// The vectors themselves, in the columns. None if they span no volume or are not finite; a left-handed box stays one.
std::optional<glm::dmat3> cell_of_vectors(const glm::dmat3& vectors);

}  // namespace meniscus
