// SPDX-License-Identifier: BSD-3-Clause
// The point of the molecule that the ray through a pixel's centre meets, and the closed part of the surface it belongs
// to.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/constants.h"
#include "core/gpu/kernel_records.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;
struct Border;
struct Face;
struct Surface;

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
  std::optional<PatchKind> kind;  ///< nothing: it is not a patch, but a cap or a shape
  glm::dvec3 position{0.0};       ///< Å
  std::uint32_t object = 0;       ///< of those that are drawn; of copies: whose
  std::uint32_t copy = 0;         ///< which of them
};

/// Looks at a surface that must outlive it. One patch may have faces in several components (an atom between the outside
/// and a cavity); then the face whose border arcs are nearest to the point decides.
class ComponentLookup {
 public:
  explicit ComponentLookup(const Surface& surface) : surface_(surface) {}

  /// Index into Surface::components; kNone for a patch without faces. point: Å, on the patch.
  std::uint32_t at(PatchKind kind, std::uint32_t patch, const glm::dvec3& point) const;

 private:
  double squared_distance(const Face& face, const glm::dvec3& point) const;

  const Surface& surface_;
};

/// Squared distance of a point to an arc, Å².
double squared_distance(const Border& border, const glm::dvec3& point);

}  // namespace meniscus
