// SPDX-License-Identifier: BSD-3-Clause
// A key light from the upper left behind the camera, a dim fill from the right, a little from above and from the
// viewer.
#include "exporters/path_tracers/lights.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/box.h"

namespace meniscus::path_tracers {
namespace {

/// Over all copies of an item.
template <class Include>
void include_places(const SceneItem& item, const Include& include) {
  const auto everywhere = [&](const glm::dvec3& x, double radius) {
    for (const RigidMotion& copy : item.copies) include(copy(x), radius);
  };
  for (const SceneMesh& mesh : item.meshes)
    for (const glm::vec3& x : mesh.positions) everywhere(glm::dvec3(x), 0.0);
  for (const SceneSphere& sphere : item.spheres) everywhere(sphere.center, sphere.radius);
  for (const SceneCylinder& cylinder : item.cylinders)
    for (const glm::dvec3& end : {cylinder.from, cylinder.to}) everywhere(end, cylinder.radius);
}

}  // namespace

Extent extent_of(const Scene& scene) {
  Box box;
  for (const SceneItem& item : scene.items)
    include_places(item, [&](const glm::dvec3& x, double radius) {
      box.include(x - radius);
      box.include(x + radius);
    });
  return {0.5 * (box.low + box.high), 0.5 * glm::length(box.high - box.low)};
}

Lights lights_of(const Scene& scene) {
  const ViewBasis view = view_basis(scene.camera);
  const auto from = [&](double x, double y, double z) {
    return glm::normalize(x * view.right + y * view.up - z * view.forward);
  };
  Lights lights;
  if (scene.material != Material::glass) {
    lights.everywhere = {0.14f, 0.15f, 0.17f};
    lights.distant = {{-from(-0.45, 0.65, 0.75), {0.76f, 0.74f, 0.7f}},
                      {-from(0.85, -0.05, 0.45), {0.13f, 0.15f, 0.17f}},
                      {-from(0.0, 0.0, 1.0), {0.11f, 0.11f, 0.12f}}};
    return lights;
  }
  const Extent extent = extent_of(scene);
  const double away = 6.0 * extent.radius;
  lights.everywhere = glm::vec3(0.25f);
  const auto add = [&](const glm::dvec3& direction, double radius, float radiance) {
    lights.softboxes.push_back({extent.center + away * direction, -direction, radius, glm::vec3(radiance)});
  };
  add(from(-0.45, 0.75, 0.45), 2.5 * extent.radius, 4.0f);
  add(from(0.9, 0.1, 0.3), 1.5 * extent.radius, 2.0f);
  // All of the picture, and what glass bends into it.
  const double depth = glm::dot(extent.center - (scene.camera.position - scene.origin), view.forward) + away;
  const double seen = glm::length(half_extent(scene.camera, static_cast<double>(scene.width) / scene.height)) *
                      (scene.camera.projection == Projection::perspective ? depth : 1.0);
  add(view.forward, 1.2 * std::max(seen, 3.0 * extent.radius), 1.0f);
  return lights;
}

}  // namespace meniscus::path_tracers
