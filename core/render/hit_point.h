// SPDX-License-Identifier: BSD-3-Clause
// Where in the molecule the ray through a pixel's centre met something, in double precision.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/index.h"
#include "core/gpu/kernel_records.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// A point on a ray.
struct HitPoint {
  double z = 0.0;            ///< distance from the camera's position (orthographic: from the plane through it), Å
  glm::dvec3 position{0.0};  ///< Å
};

/// pixel: column, row from the top, of the whole picture; t: ray_cast::Hit::t.
HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t);

/// What the ray through the centre of a pixel hits.
struct PickedPoint {
  std::uint32_t atom = kNone;     ///< index into the atoms of the object
  std::optional<PatchKind> kind;  ///< nothing: it is no patch, but a cap or a shape
  glm::dvec3 position{0.0};       ///< Å
  std::uint32_t object = 0;       ///< of those that are drawn; of copies: whose
  std::uint32_t copy = 0;         ///< which of them
};

}  // namespace meniscus
