// SPDX-License-Identifier: BSD-3-Clause
// Places the lights of a scene, and writes numbers as the shortest text that reads back the same.
#include "exporters/path_tracers/path_tracer_scene.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/math/box.h"

namespace meniscus::path_tracers {
namespace {

/// Calls include(point, radius) for the balls that bound each copy of an item.
template <class Include>
void include_places(const SceneItem& item, const Include& include) {
  const auto include_copies = [&](const glm::dvec3& x, double radius) {
    for (const RigidMotion& copy : item.copies) include(copy(x), radius);
  };
  for (const SceneMesh& mesh : item.meshes)
    for (const glm::vec3& x : mesh.positions) include_copies(glm::dvec3(x), 0.0);
  for (const SceneSphere& sphere : item.spheres) include_copies(sphere.center, sphere.radius);
  for (const SceneCylinder& cylinder : item.cylinders)
    for (const glm::dvec3& end : {cylinder.from, cylinder.to}) include_copies(end, cylinder.radius);
}

}  // namespace

Extent extent_of(const PathTracerScene& scene) {
  Box box;
  for (const SceneItem& item : scene.items)
    include_places(item, [&](const glm::dvec3& x, double radius) {
      box.include(x - radius);
      box.include(x + radius);
    });
  return {0.5 * (box.low + box.high), 0.5 * glm::length(box.high - box.low)};
}

Lights lights_of(const PathTracerScene& scene) {
  const ViewBasis view = view_basis(scene.camera);
  const auto from = [&](double x, double y, double z) {
    return glm::normalize(x * view.right + y * view.up - z * view.forward);
  };
  Lights lights;
  if (scene.material != Material::glass) {
    lights.environment = {0.14f, 0.15f, 0.17f};
    lights.distant = {{-from(-0.45, 0.65, 0.75), {0.76f, 0.74f, 0.7f}},
                      {-from(0.85, -0.05, 0.45), {0.13f, 0.15f, 0.17f}},
                      {-from(0.0, 0.0, 1.0), {0.11f, 0.11f, 0.12f}}};
    return lights;
  }
  const Extent extent = extent_of(scene);
  const double away = 6.0 * extent.radius;
  lights.environment = glm::vec3(0.25f);
  const auto add = [&](const glm::dvec3& direction, double radius, float radiance) {
    lights.softboxes.push_back({extent.center + away * direction, -direction, radius, glm::vec3(radiance)});
  };
  add(from(-0.45, 0.75, 0.45), 2.5 * extent.radius, 4.0f);
  add(from(0.9, 0.1, 0.3), 1.5 * extent.radius, 2.0f);
  // The background softbox fills the picture, with a margin for rays that glass refracts.
  const double depth = glm::dot(extent.center - (scene.camera.position - scene.origin), view.forward) + away;
  const double seen = glm::length(half_extent(scene.camera, static_cast<double>(scene.width) / scene.height)) *
                      (scene.camera.projection == Projection::perspective ? depth : 1.0);
  add(view.forward, 1.2 * std::max(seen, 3.0 * extent.radius), 1.0f);
  return lights;
}

namespace {

template <class T>
std::string finite_text(T value) {
  if (!std::isfinite(value)) throw Error("export of a scene: a number of the surface is not finite");
  return fmt::format("{}", value == T(0) ? T(0) : value);  // no -0
}

template <class Vector>
std::string joined(const Vector& v, std::string_view between) {
  return fmt::format("{}{}{}{}{}", number_text(v.x), between, number_text(v.y), between, number_text(v.z));
}

}  // namespace

std::string number_text(double value) { return finite_text(value); }
std::string number_text(float value) { return finite_text(value); }
std::string vector_text(const glm::dvec3& v, std::string_view between) { return joined(v, between); }
std::string vector_text(const glm::vec3& v, std::string_view between) { return joined(v, between); }

}  // namespace meniscus::path_tracers
