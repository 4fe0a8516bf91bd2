// SPDX-License-Identifier: BSD-3-Clause
// Computes the matrices of cameras from their axes.
#include "core/camera/camera_matrices.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "core/camera/camera.h"

namespace meniscus {

glm::dmat4 world_to_camera(const Camera& camera) {
  const ViewBasis basis = view_basis(camera);
  const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, camera.position)); };
  return glm::transpose(
      glm::dmat4(row(basis.right), row(basis.up), row(basis.forward), glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

glm::dmat4 world_to_picture(const Camera& camera, double aspect) {
  const glm::dvec2 half = half_extent(camera, aspect);
  const bool is_perspective = camera.projection == Projection::perspective;
  // The third row only makes the matrix invertible.
  const glm::dvec4 divisor = is_perspective ? glm::dvec4(0, 0, 1, 0) : glm::dvec4(0, 0, 0, 1);
  const glm::dmat4 projection = glm::transpose(glm::dmat4(glm::dvec4(0.5 / half.x, 0, 0, 0) + 0.5 * divisor,
                                                          glm::dvec4(0, -0.5 / half.y, 0, 0) + 0.5 * divisor,
                                                          glm::dvec4(0, 0, 1, is_perspective ? -1 : 0), divisor));
  return projection * world_to_camera(camera);
}

glm::dvec2 place_in_picture(const Camera& camera, const glm::dvec2& size, const glm::dvec3& point) {
  const glm::dvec4 place = world_to_picture(camera, size.x / size.y) * glm::dvec4(point, 1.0);
  return size * glm::dvec2(place) / place.w;
}

}  // namespace meniscus
