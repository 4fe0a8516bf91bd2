// SPDX-License-Identifier: BSD-3-Clause
// Provides the clip planes of convex patches, whether a surface lists them or not.
#pragma once

#include "core/math/ball.h"
#include "core/surface/primitives.h"

namespace meniscus {

enum class PlaneChoice {
  bordering,  ///< at least the contact circles that border the patch; the region that they leave contains the patch
  all         ///< the planes that leave the patch and nothing else
};

/// The clip planes of convex patches by index: from the tables of a surface, or found on request. Several threads may
/// use it at once.
class ConvexPlanes {
 public:
  virtual ~ConvexPlanes() = default;

  virtual std::vector<Plane> of(std::uint32_t convex, PlaneChoice choice) const = 0;

  /// True if a plane cuts off the point of the patch's sphere in this direction from its centre.
  virtual bool cut_off(std::uint32_t convex, const glm::dvec3& direction) const = 0;
};

/// True if the point lies outside any of the half-spaces.
inline bool cut_off_by(std::span<const Plane> planes, const glm::dvec3& point) {
  return std::ranges::any_of(planes, [&](const Plane& p) { return glm::dot(p.normal, point) > p.offset; });
}

/// The clip planes that the tables of a surface list.
class ListedPlanes final : public ConvexPlanes {
 public:
  explicit ListedPlanes(const Surface& surface) : s_(surface) {}

  std::vector<Plane> of(std::uint32_t convex, PlaneChoice) const override {
    const std::span<const Plane> planes = listed(convex);
    return {planes.begin(), planes.end()};
  }
  bool cut_off(std::uint32_t convex, const glm::dvec3& direction) const override {
    const Ball& atom = s_.atoms[s_.convex[convex].atom];
    return cut_off_by(listed(convex), atom.center + atom.radius * direction);
  }

 private:
  std::span<const Plane> listed(std::uint32_t convex) const {
    return std::span(s_.planes).subspan(s_.convex[convex].first_plane, s_.convex[convex].plane_count);
  }

  const Surface& s_;
};

}  // namespace meniscus
