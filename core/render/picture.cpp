// SPDX-License-Identifier: BSD-3-Clause
// Decides which objects need layers, and computes balls that enclose a picture's objects.
#include "core/color/coloring.h"
#include "core/render/picture.h"
#include "core/shapes/shapes.h"
#include "core/surface/primitives.h"

namespace meniscus {

glm::dvec3 hatching_direction(const glm::dvec3& normal) {
  const glm::dvec3 axis = std::abs(normal.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, axis)), v = glm::cross(normal, u);
  return u + v;
}

bool needs_layers(const PictureObject& object) {
  return object.shapes || !object.clip.empty() ||
         std::ranges::any_of(object.coloring->opacity, [](float a) { return a > 0.0f && a < 1.0f; });
}

std::vector<Ball> enclosing_balls(std::span<const PictureObject> objects) {
  std::vector<Ball> balls;
  for (const PictureObject& object : objects) {
    if (object.surface) balls.insert(balls.end(), object.surface->atoms.begin(), object.surface->atoms.end());
    if (!object.shapes) continue;
    for (const SphereShape& sphere : object.shapes->spheres) balls.push_back({sphere.center, sphere.radius});
    for (const CylinderShape& cylinder : object.shapes->cylinders)
      for (const glm::dvec3& end : {cylinder.from, cylinder.to}) balls.push_back({end, cylinder.radius});
    for (const glm::dvec3& corner : object.shapes->mesh.positions) balls.push_back({corner, 0.0});
  }
  return balls;
}

std::vector<Ball> kept_balls(std::span<const PictureObject> objects) {
  std::vector<Ball> kept;
  for (const PictureObject& object : objects)
    for (const Ball& ball : enclosing_balls({&object, 1}))
      if (std::ranges::none_of(object.clip, [&](const ClipPlane& plane) {
            return glm::dot(plane.normal, ball.center) - ball.radius >= plane.offset;
          }))
        kept.push_back(ball);
  return kept;
}

}  // namespace meniscus
