// SPDX-License-Identifier: BSD-3-Clause
// Which atom colours each point of a cap.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/ball.h"
#include "core/math/ball_grid.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The atoms that caps are coloured by: at each point the one whose van der Waals sphere is nearest, of equally near
/// ones the first.
class CapAtoms {
 public:
  /// part: one per atom. Where atoms of two parts are equally near, triangles of caps end.
  CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part);

  struct Nearest {
    std::uint32_t atom = kNone;
    double distance = 0.0;  ///< Å from its sphere, negative within
    double gap = 0.0;       ///< Å: atoms of other parts are farther by so much at least
  };
  Nearest nearest(const glm::dvec3& point) const;
  /// Å from the sphere of an atom.
  double distance(std::uint32_t atom, const glm::dvec3& point) const;

  std::uint32_t part(std::uint32_t atom) const { return part_[atom]; }
  bool has_parts() const { return has_parts_; }
  /// Å: no point of the solid is farther from the nearest sphere.
  double farthest() const { return probe_radius_; }

 private:
  std::vector<Ball> atoms_;
  std::vector<std::uint32_t> part_;
  double probe_radius_ = 0.0, largest_ = 0.0;
  bool has_parts_ = false;
  BallGrid grid_;
};

}  // namespace meniscus
