// SPDX-License-Identifier: BSD-3-Clause
// Numbers of materials that scenes of all formats share.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

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

}  // namespace meniscus::path_tracers
