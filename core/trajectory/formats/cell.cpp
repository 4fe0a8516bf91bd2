// SPDX-License-Identifier: BSD-3-Clause
// Computes the vectors of a periodic box from its edges and angles.
#include "core/trajectory/formats/cell.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace meniscus {

std::optional<glm::dmat3> cell_of_cosines(const glm::dvec3& edges, const glm::dvec3& cosines) {
  if (!(edges.x > 0.0 && edges.y > 0.0 && edges.z > 0.0)) return std::nullopt;
  const double sine = std::sqrt(1.0 - cosines.z * cosines.z);
  const double x = cosines.y, y = (cosines.x - cosines.y * cosines.z) / sine;
  const double height = std::sqrt(1.0 - x * x - y * y);  // NaN where the angles do not fit together
  return cell_of_vectors(glm::dmat3(glm::dvec3(edges.x, 0.0, 0.0), edges.y * glm::dvec3(cosines.z, sine, 0.0),
                                    edges.z * glm::dvec3(x, y, height)));
}

std::optional<glm::dmat3> cell_of_angles(const glm::dvec3& edges, const glm::dvec3& degrees) {
  glm::dvec3 cosines;
  for (int n = 0; n < 3; ++n) {
    if (!(degrees[n] > 0.0 && degrees[n] < 180.0)) return std::nullopt;
    // Of the complement, because the cosine of pi/2 is not zero in double precision.
    cosines[n] = std::sin((90.0 - degrees[n]) * (std::numbers::pi / 180.0));
  }
  return cell_of_cosines(edges, cosines);
}

std::optional<glm::dmat3> cell_of_vectors(const glm::dmat3& vectors) {
  const double volume = std::abs(glm::determinant(vectors));
  if (!(volume > 0.0) || !std::isfinite(volume)) return std::nullopt;
  return vectors;
}

}  // namespace meniscus
