// SPDX-License-Identifier: BSD-3-Clause
// A finished picture in memory: colour, and what is known about the point each pixel's central ray hits.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus {

/// Rows from the top, pixels from the left. All AOV arrays are empty unless they were asked for.
struct Framebuffer {
  glm::ivec2 size{0};
  std::vector<glm::vec4> color;  ///< linear, alpha-premultiplied, alpha = share of the pixel's samples that hit

  /// Distance along the ray from the camera's position (orthographic: from the plane through it), Å; +inf: no hit.
  std::vector<float> z;
  std::vector<glm::vec3> normal;         ///< towards the solvent; 0 where nothing is hit
  std::vector<glm::vec3> position;       ///< Å; 0 where nothing is hit
  std::vector<std::uint32_t> atom;       ///< index into Surface::atoms, or kNone
  std::vector<std::uint32_t> kind;       ///< PatchKind, kShape, kCap, or kNone
  std::vector<std::uint32_t> component;  ///< index into Surface::components, or kNone
  std::vector<std::uint32_t> object;     ///< of several: which one; empty for one

  /// Beyond PatchKind: on a shape beside a surface, on a plane that cuts one.
  static constexpr std::uint32_t kShape = 3, kCap = 4;
};

}  // namespace meniscus
