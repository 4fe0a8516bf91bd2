// SPDX-License-Identifier: BSD-3-Clause
// Matrices of cameras agree with the rays of their pixels.
#include "core/camera/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

TEST(CameraMatrices, PutPointsOfARayAtItsPixel) {
  Camera camera{.position = {3, -2, 40}, .target = {1, 1, 0}, .up = {0.3, 1, 0}, .vertical_fov = 25.0, .height = 18.0};
  const glm::dvec2 size(64, 48);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    camera.projection = projection;
    for (const glm::dvec2 pixel : {glm::dvec2(0.5, 0.5), glm::dvec2(63.5, 10.5), glm::dvec2(20.25, 47.0)})
      for (const double distance : {1.0, 25.0, 300.0}) {
        const Ray ray = pixel_ray(camera, size, pixel);
        const glm::dvec2 place = place_in_picture(camera, size, ray.origin + distance * ray.direction);
        EXPECT_LT(glm::distance(place, pixel), 1e-9);
      }
  }
}

TEST(CameraMatrices, HaveTheViewAlongZ) {
  const Camera camera{.position = {3, -2, 40}, .target = {1, 1, 0}, .up = {0.3, 1, 0}};
  const ViewBasis basis = view_basis(camera);
  const glm::dvec4 place = world_to_camera(camera) *
                           glm::dvec4(camera.position + 2.0 * basis.right + 3.0 * basis.up + 5.0 * basis.forward, 1.0);
  EXPECT_LT(glm::distance(place, glm::dvec4(2, 3, 5, 1)), 1e-12);
}

}  // namespace
}  // namespace meniscus
