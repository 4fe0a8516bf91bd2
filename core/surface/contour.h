// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up: the exposed arcs of the circle of two balls among other balls (Totrov & Abagyan 1996).
//
// The same code finds RS edges (balls = SAS balls of atoms) and the cusp curves of concave patches (balls = fixed
// probes). Decisions are taken in double with an error bound; a circle with a doubtful decision is done again in
// quadruple precision, where the decision weights (see reduced_surface.h) leave no ties.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/geometry.h"

namespace meniscus {

/// A ball that may cover part of a circle, relative to the circle's first ball.
struct Blocker {
  glm::dvec3 center{0.0};
  double weight = 0.0;
  std::uint32_t label = 0;
};

/// A part of the circle that is covered whatever the balls say: dot(normal, (x, y)) > offset in the circle's frame.
struct BlockedHalf {
  geometry::HalfPlane half_plane;
  std::uint32_t label = 0;
};

/// An exposed arc: unit vectors in the circle's frame (u, v), and who covers the circle before and after.
struct ExposedArc {
  glm::dvec2 begin{0.0};
  glm::dvec2 end{0.0};
  std::uint32_t begin_by = 0;
  std::uint32_t end_by = 0;
  double begin_error = 0.0;
  double end_error = 0.0;
};

/// What is left of one circle. Reused from circle to circle to save allocations.
class Contour {
 public:
  /// The circle of the balls (0, w0) and (d, w1) among `blockers`; the blocker at index `skip` is ignored.
  /// Afterwards: whole() = nothing covers any of it; else arcs() (possibly none), in no particular order.
  void expose(const glm::dvec3& d, double w0, double w1, std::span<const Blocker> blockers, std::size_t skip,
              std::span<const BlockedHalf> halves = {});

  bool whole() const { return whole_; }
  const std::vector<ExposedArc>& arcs() const { return arcs_; }
  const geometry::Circle& circle() const { return circle_; }
  std::size_t doubtful_count() const { return doubtful_count_; }  ///< circles redone in quadruple precision so far

 private:
  bool expose_in_double(double w0, std::span<const Blocker> blockers, std::size_t skip,
                        std::span<const BlockedHalf> halves);
  void expose_in_quad(const glm::dvec3& d, double w0, double w1, std::span<const Blocker> blockers, std::size_t skip,
                      std::span<const BlockedHalf> halves);

  geometry::Circle circle_;
  bool whole_ = false;
  std::vector<ExposedArc> arcs_;
  std::vector<ExposedArc> next_;
  std::size_t doubtful_count_ = 0;
};


}  // namespace meniscus
