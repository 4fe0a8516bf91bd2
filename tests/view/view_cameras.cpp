// SPDX-License-Identifier: BSD-3-Clause
// Places random cameras.
#include "tests/view/view_cameras.h"

#include <glm/geometric.hpp>

#include "core/queries/surface_parts.h"

namespace meniscus::testing {
namespace {

glm::dvec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

double uniform(std::mt19937& random) { return std::uniform_real_distribution<double>()(random); }

}  // namespace

Camera camera_outside(std::span<const Ball> atoms, double aspect, std::mt19937& random) {
  Camera camera = frame_camera(atoms, aspect);
  const double distance = glm::length(camera.position - camera.target) * (0.6 + uniform(random));
  camera.position = camera.target + distance * glm::normalize(random_vector(random));
  camera.up = random_vector(random);
  if (random() % 2 == 0) {
    camera.projection = Projection::orthographic;
    camera.height = 0.4 * distance;
  }
  return camera;
}

Camera camera_inside(std::span<const Ball> atoms, double probe_radius, std::mt19937& random) {
  Camera camera;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const Ball& near = atoms[random() % atoms.size()];
    const glm::dvec3 direction = glm::normalize(random_vector(random));
    camera.position = near.center + direction * (near.radius + 4.0 * uniform(random));
    if (in_solvent(atoms, probe_radius, camera.position)) break;
  }
  camera.target = camera.position + random_vector(random);
  camera.up = random_vector(random);
  camera.vertical_fov = 40.0 + 80.0 * uniform(random);
  return camera;
}

}  // namespace meniscus::testing
