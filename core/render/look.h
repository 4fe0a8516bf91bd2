// SPDX-License-Identifier: BSD-3-Clause
// How a picture looks, apart from what it shows.
#pragma once

#include <glm/vec3.hpp>

namespace meniscus {

/// Light, air and ink of a finished picture. The same picture comes out again each time: no effect draws lots.
struct Look {
  glm::vec3 background{1.0f};  ///< sRGB in [0, 1]

  /// Towards the key light, in the picture's axes (right, up, towards the viewer); any length but 0.
  glm::vec3 light_direction{-0.45f, 0.65f, 0.75f};
  float light_strength = 1.0f;  ///< of the key light, >= 0

  /// Strength in [0, 1] of the shade in pockets and clefts. From the picture alone (ground-truth ambient occlusion,
  /// Jimenez et al. 2016): what the picture does not show casts no shade.
  float ambient_occlusion = 0.0f;
  /// How far shade is cast, Å; in the picture it reaches no farther than 256 pixels.
  float ambient_occlusion_radius = 8.0f;

  /// Width in pixels, at most 16, of black lines where something stands in front of something else, the stronger the
  /// farther, and where parts meet (Coloring::part). 0: none.
  float silhouettes = 0.0f;

  /// Share in [0, 1] by which the farthest atoms fade into the background; the nearest do not.
  float depth_cue = 0.0f;

  /// True if colours change after they are cast.
  bool has_effects() const { return ambient_occlusion > 0.0f || silhouettes > 0.0f || depth_cue > 0.0f; }
};

inline constexpr float kWidestSilhouette = 16.0f;  ///< pixels
inline constexpr int kLongestShade = 256;          ///< pixels

/// How far around a pixel its colour depends on what is shown, in whole tiles of 16 pixels; in pixels.
inline int look_reach(const Look& look) {
  return look.ambient_occlusion > 0.0f ? kLongestShade + 16 : look.silhouettes > 0.0f ? 16 : 0;
}

}  // namespace meniscus
