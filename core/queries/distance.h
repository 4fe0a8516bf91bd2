// SPDX-License-Identifier: BSD-3-Clause
// The exact distance from a point to the surface, and the surface's point that is nearest.
#pragma once

#include <cstdint>
#include <memory>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// The surface as seen from some point.
struct NearestPoint {
  double distance = 0.0;  ///< Å, Euclidean: above 0 in the solvent, below 0 in the solid
  glm::dvec3 point{0.0};  ///< Å, on the surface; one of them where several are equally near
};

/// Answers any number of questions about one surface, from any number of threads. Exact but for rounding, anywhere:
///  * A point of the solid is as far from the surface as from the accessible region A, less the probe's radius: on the
///    way to the nearest place of the probe the distance from A falls by a step's length with each step. That place
///    lies on a SAS sphere, on an arc, or is a fixed probe.
///  * From the solvent the nearest point is a foot inside of a patch, where the line to it is normal to a sphere or a
///    torus; or a foot on a border; or a vertex. All of them are tried, those in nearer boxes first.
class SurfaceDistance {
 public:
  /// surface: closed, with at least one atom; it must stay and not change.
  explicit SurfaceDistance(const Surface& surface);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;
  SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

  /// Å, the largest coordinate that a point may have: squares of distances are finite.
  static constexpr double kFarthest = 1e150;

  NearestPoint operator()(const glm::dvec3& point) const;

  /// Whether the point is no farther from the surface than that, on either side; limit > 0, Å. Sooner known than how
  /// far it is.
  bool is_within(const glm::dvec3& point, double limit) const;

  /// Å, from the point to the nearest place where a probe touches an atom, whichever side of the SAS the point is on.
  /// Places are those of the surface's patches: of a part of a surface (part.h), of that part alone.
  double to_probe(const glm::dvec3& point) const;

  /// Whether a probe there would reach into an atom; of a part of a surface, into one that the part has.
  bool in_sas(const glm::dvec3& point) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace meniscus
