// SPDX-License-Identifier: BSD-3-Clause
// Carries points of surfaces and shapes to the next frame, and compares their places in both pictures.
#include "core/scene/figure_motion.h"

#include "core/base/constants.h"
#include "core/camera/camera_matrices.h"
#include "core/queries/surface_object.h"

namespace meniscus {

std::vector<glm::dvec3> placed_ways(std::span<const SurfaceObject> objects, std::span<const glm::dvec3> atoms) {
  std::vector<glm::dvec3> ways;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const std::uint32_t atom : object.atom) ways.push_back(copy.rotation * atoms[atom]);
  return ways;
}

void PointMotion::add(const Surface& surface, std::span<const glm::dvec3> atoms) {
  Object& object = objects_.emplace_back();
  object.atoms.assign(atoms.begin(), atoms.end());
  object.surface.emplace_back(surface, atoms);
}

glm::vec2 PointMotion::at(const SeenPoint& point) const {
  if (point.atom == kNone) return glm::vec2(0.0f);
  const Object& object = objects_[point.object];
  glm::dvec3 way = (object.surface.empty() ? motion_.atoms : object.atoms)[point.atom];
  if (!object.surface.empty() && point.kind < Framebuffer::kShape)
    way = object.surface.front().at(static_cast<PatchKind>(point.kind), point.patch, point.position, point.normal);
  const glm::dvec2 change =
      place_in_picture(motion_.camera, size_, point.position + way) - place_in_picture(camera_, size_, point.position);
  return {static_cast<float>(change.x), static_cast<float>(-change.y)};
}

}  // namespace meniscus
