// SPDX-License-Identifier: BSD-3-Clause
// The parts that scenes of all formats share: lights, parameters of materials, and numbers as text.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus::path_tracers {

/// Parallel light.
struct DistantLight {
  glm::dvec3 direction{0.0};  ///< direction of travel, of unit length
  glm::vec3 strength{0.0f};   ///< radiance of a white matte surface under perpendicular light
};

/// A disc with uniform radiance that faces the scene.
struct Softbox {
  glm::dvec3 center{0.0};     ///< Å, from the scene's origin
  glm::dvec3 direction{0.0};  ///< of unit length, towards the scene
  double radius = 0.0;        ///< Å
  glm::vec3 radiance{0.0f};
};

/// All lights of a scene.
struct Lights {
  glm::vec3 environment{0.0f};  ///< radiance of the uniform environment
  std::vector<DistantLight> distant;
  std::vector<Softbox> softboxes;
};

/// A ball around a whole scene.
struct Extent {
  glm::dvec3 center{0.0};  ///< Å, from the scene's origin
  double radius = 1.0;     ///< Å
};
/// Returns a ball around all copies of all items.
Extent extent_of(const PathTracerScene& scene);

/// Returns the lights of a scene, at fixed directions relative to the camera. Glass reflects and refracts its
/// surroundings, so it gets softboxes; all other materials get distant lights.
Lights lights_of(const PathTracerScene& scene);

/// The index of refraction of glass, and its absorption coefficient in 1/Å, as in the POV-Ray scene.
inline constexpr double kGlassIor = 1.45;
inline const glm::vec3 kGlassAbsorption{0.4f / 30.0f, 0.25f / 30.0f, 0.2f / 30.0f};
/// The index of refraction and the roughness of the coat of plastic. The roughness is perceptual, which is the square
/// root of that of microfacets.
inline constexpr double kCoatIor = 1.45, kCoatRoughness = 0.35;
/// The index of refraction and the roughness of the boundary of wax, and its mean free path of light per channel, in Å.
inline constexpr double kWaxIor = 1.4, kWaxRoughness = 0.4;
inline const glm::vec3 kWaxMeanFreePath{1.6f, 1.0f, 0.8f};

/// Returns the colour that is written into a scene. The colour of glass applies twice, where light enters and where it
/// leaves; after both, 0.4 of the light that `color` would absorb remains.
inline glm::vec3 written_color(Material material, bool is_surface, const glm::vec3& color) {
  if (!is_surface || material != Material::glass) return color;
  const auto once = [](float channel) { return std::sqrt(0.4f + 0.6f * channel); };
  return {once(color.x), once(color.y), once(color.z)};
}

/// Returns the shortest text that reads back as the same number. Throws Error for a number that is not finite, so that
/// a scene never contains nan or inf.
std::string number_text(double value);
std::string number_text(float value);
/// Returns the texts of three numbers, separated by `between`. Throws what number_text() throws.
std::string vector_text(const glm::dvec3& v, std::string_view between = " ");
std::string vector_text(const glm::vec3& v, std::string_view between = " ");

}  // namespace meniscus::path_tracers
