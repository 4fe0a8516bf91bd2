// SPDX-License-Identifier: BSD-3-Clause
// The solid that a large probe rolls over, and the lattice cells in it where a small probe can be.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/queries/distance.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The solid of a solvent-excluded surface with its cavities filled. A larger probe has a larger hull, because a ball
/// is a union of smaller ones. Probes that overlap one outside count as outside, although a door between the two may be
/// too narrow for them.
class Hull {
 public:
  /// `surface` is closed, with at least one atom, a probe radius above 0, and listed clip planes.
  explicit Hull(Surface surface);
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  double volume() const { return volume_; }  ///< Å³, exact
  /// True if some cavities were filled.
  bool has_cavities() const { return part_.has_value(); }
  /// Returns the surface of the hull; its atoms are those that a probe outside of cavities touches.
  const Surface& surface() const { return part_ ? *part_ : whole_; }

  /// Returns the distance (Å) from the point to the nearest place of the centre of a probe that is in no cavity; 0 at
  /// such a place. Points of the hull are those with a distance of at least the probe's radius; the excess is their
  /// depth.
  double to_probe(const glm::dvec3& point) const;

 private:
  Surface whole_;
  SurfaceDistance anywhere_;
  std::optional<Surface> part_;  ///< the surface without cavities, if there are any
  std::optional<SurfaceDistance> outside_;
  double volume_ = 0.0;
};

/// True if places of the probe's centre within `reach` (Å) of a point may be needed.
using NearWanted = std::function<bool(const glm::dvec3& point, double reach)>;

/// The largest distances (Å) between places along an arc, and on the sphere of an atom of a given radius. On a sphere
/// no point is farther from the nearest place than 0.77 of that distance (spiral.h).
struct PlaceSteps {
  double on_arcs;
  std::function<double(double atom_radius)> on_sphere;
};

/// Returns every fixed probe, and places along arcs and on faces of the SAS, in the order of the surface's patches.
/// Each of them touches its atoms exactly. Left out are places that are not `wanted`, and all but the first of places
/// closer than kSamePlace. `bounds` encloses all wanted places.
std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted);

inline constexpr double kSamePlace = 1e-3;  ///< Å

/// Cubes that together hold every place where a probe touches no ball and is at least `clearance` from the large
/// probe's centre. Larger cubes are halved down to half an Ångström, unless all of a cube is such a place. This works
/// because both distances change by no more than the length of a step.
class ProbeCells {
 public:
  /// `atoms` are those of the hull, `probe_radius` is that of the small probe (Å), and `clearance` (Å) is the smallest
  /// Hull::to_probe() of its centre. Runs on all cores that TBB may use; the cells do not depend on their number.
  ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance);

  std::size_t count() const { return boxes_.size(); }
  /// Returns the box around all cells, extended by `reach` (Å) on each side. There must be a cell.
  Box bounds(double reach) const;
  /// True if some cell is no farther than `reach` (Å) from the point; with 0, if one holds the point.
  bool within(const glm::dvec3& point, double reach) const;

 private:
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace meniscus
