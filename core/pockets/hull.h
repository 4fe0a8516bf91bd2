// SPDX-License-Identifier: BSD-3-Clause
// The solid that a large probe rolls over: the depth of a point in it, and positions of that probe around a molecule.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/queries/distance.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct Surface;

/// The solid of a solvent-excluded surface with its cavities filled. A larger probe has a larger hull, for a ball is a
/// union of smaller ones. Probes that overlap one outside count as outside, though they may be behind a door that is
/// too narrow for them.
class Hull {
 public:
  /// surface: closed, with at least one atom and a probe above 0, with listed clip planes.
  explicit Hull(Surface surface);
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  double volume() const { return volume_; }  ///< Å³, exact
  /// Whether some were filled.
  bool has_cavities() const { return part_.has_value(); }
  /// Of the hull; its atoms are those that a probe touches which is in no cavity.
  const Surface& surface() const { return part_ ? *part_ : whole_; }

  /// Å, from the point to the nearest place where the centre of a probe may be that is in no cavity; 0 in such a place.
  /// Points of the hull are those for which this is the probe's radius or more; how much more is their depth.
  double to_probe(const glm::dvec3& point) const;

 private:
  Surface whole_;
  SurfaceDistance anywhere_;
  std::optional<Surface> part_;  ///< without cavities, if there are any
  std::optional<SurfaceDistance> outside_;
  double volume_ = 0.0;
};

/// Whether places of the probe's centre may be wanted that are no farther than `reach` (Å) from a point.
using NearWanted = std::function<bool(const glm::dvec3& point, double reach)>;

/// Å between places, at most: along an arc, and on the sphere of an atom of this radius, where no point is farther from
/// the nearest place than 0.77 of that (spiral.h).
struct PlaceSteps {
  double on_arcs;
  std::function<double(double atom_radius)> on_sphere;
};

/// Every fixed probe, and places along arcs and on faces of the SAS, each of which exactly touches its atoms. Left out
/// are places that are not wanted, and all but the first of those closer than kSamePlace. In the order of the surface's
/// patches. bounds: around all places that are wanted.
std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted);

inline constexpr double kSamePlace = 1e-3;  ///< Å

}  // namespace meniscus
