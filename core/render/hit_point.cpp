// SPDX-License-Identifier: BSD-3-Clause
// Goes along the ray as far as the kernel says.
#include "core/render/hit_point.h"

#include <glm/geometric.hpp>

namespace meniscus {

HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t) {
  const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts from the plane through the pivot.
  const double z = t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  return {z, ray.origin + ray.direction * z};
}

}  // namespace meniscus
