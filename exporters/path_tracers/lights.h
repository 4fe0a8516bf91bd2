// SPDX-License-Identifier: BSD-3-Clause
// The lights of a scene: those of the view, from everywhere and from far away.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// Parallel light.
struct DistantLight {
  glm::dvec3 direction{0.0};  ///< unit, that it travels in
  glm::vec3 strength{0.0f};   ///< radiance of a white matte surface that it falls upon straight
};

/// A disc that shines evenly on the scene.
struct Softbox {
  glm::dvec3 center{0.0};     ///< Å, from the scene's origin
  glm::dvec3 direction{0.0};  ///< unit, towards the scene
  double radius = 0.0;        ///< Å
  glm::vec3 radiance{0.0f};
};

struct Lights {
  glm::vec3 everywhere{0.0f};  ///< radiance
  std::vector<DistantLight> distant;
  std::vector<Softbox> softboxes;
};

/// A ball around all of a scene, from its origin.
struct Extent {
  glm::dvec3 center{0.0};
  double radius = 1.0;  ///< Å
};
Extent extent_of(const Scene& scene);

/// They stand as the camera sees them. Distant ones for what is matte; glass mirrors and bends what is around it, so
/// that it has softboxes instead.
Lights lights_of(const Scene& scene);

}  // namespace meniscus::path_tracers
