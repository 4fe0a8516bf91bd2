// SPDX-License-Identifier: BSD-3-Clause
// Which closed part of the surface a point of a patch belongs to.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace meniscus {

enum class PatchKind : std::uint8_t;
struct Border;
struct Face;
struct Surface;

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
