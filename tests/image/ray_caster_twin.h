// SPDX-License-Identifier: BSD-3-Clause
// A second ray caster: in double on the CPU, by brute force over the surface's tables, without tiles or packing.
#pragma once

#include <optional>
#include <vector>

#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus::testing {

struct TwinHit {
  double t = 0.0;  ///< Å along the ray
  glm::dvec3 normal{0.0};
  PatchKind kind = PatchKind::convex;
  std::uint32_t patch = 0;
  std::uint32_t atom = 0;  ///< The point takes this atom's colour.
};

/// Keeps a reference to a surface that must outlive it.
class RayCasterTwin {
 public:
  /// coloring: tells which atoms are hidden.
  explicit RayCasterTwin(const Surface& surface, const Coloring& coloring = {});

  /// Returns the nearest point of any patch on the ray.
  std::optional<TwinHit> trace(const Ray& ray) const;

 private:
  struct Candidate {
    glm::dvec3 center;
    double radius;
    PatchKind kind;
    std::uint32_t patch;
  };

  double hit(const Candidate& candidate, const Ray& ray, double nearest) const;
  double hit_toroidal(const Candidate& candidate, const Ray& ray, double nearest) const;
  double hit_sphere(const Candidate& candidate, std::uint32_t first_plane, std::uint32_t plane_count, const Ray& ray,
                    double nearest) const;
  bool shows(const Candidate& candidate, const Ray& ray, double t) const;
  TwinHit describe(const Candidate& candidate, const Ray& ray, double t) const;

  const Surface& surface_;
  Coloring coloring_;
  std::vector<Candidate> candidates_;
};

}  // namespace meniscus::testing
