// SPDX-License-Identifier: BSD-3-Clause
// What scenes of all formats share: lights, numbers of materials, and numbers as text.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
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

/// They are as the camera sees them. Distant ones for what is matte; glass mirrors and bends what is around it, so
/// that it has softboxes instead.
Lights lights_of(const Scene& scene);

/// Of glass: the index of refraction, and what is absorbed on a way of 1 Å, as in the POV-Ray scene.
inline constexpr double kGlassIor = 1.45;
inline const glm::vec3 kGlassAbsorption{0.4f / 30.0f, 0.25f / 30.0f, 0.2f / 30.0f};
/// Of plastic: roughness as artists mean it, the square root of that of microfacets.
inline constexpr double kCoatIor = 1.45, kCoatRoughness = 0.35;
/// Of wax: the boundary, and the way (Å) that light goes until it is scattered.
inline constexpr double kWaxIor = 1.4, kWaxRoughness = 0.4;
inline const glm::vec3 kWaxMeanFreePath{1.6f, 1.0f, 0.8f};

/// The colour that a scene states. Light passes glass twice, in and out, and keeps then 0.4 of what would be lost.
inline glm::vec3 written_color(Material material, bool is_surface, const glm::vec3& color) {
  if (!is_surface || material != Material::glass) return color;
  const auto once = [](float channel) { return std::sqrt(0.4f + 0.6f * channel); };
  return {once(color.x), once(color.y), once(color.z)};
}

/// Throw Error for what is not finite: a scene never holds nan or inf.
std::string number_text(double value);
std::string number_text(float value);
/// Three of them.
std::string vector_text(const glm::dvec3& v, std::string_view between = " ");
std::string vector_text(const glm::vec3& v, std::string_view between = " ");

}  // namespace meniscus::path_tracers
