// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up: the exposed arcs of the circle of two balls among other balls (Totrov & Abagyan 1996).
//
// The same code finds RS edges (balls = SAS balls of atoms) and the cusp curves of concave patches (balls = fixed
// probes). Decisions are taken in double with an error bound; a circle with a doubtful decision is done again in
// quadruple precision, where the decision weights (see reduced_surface.h) leave no ties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/geometry.h"

namespace meniscus {

namespace geometry {

/// What balls leave of one circle, in double precision.
struct Remainder {
  std::vector<ExposedArc> exposed_arcs;  ///< the first exposed_count count
  bool hold_arcs(uint count) {
    if (exposed_arcs.size() < count) exposed_arcs.resize(count);
    return true;
  }
#include "gpu_shaders/geometry/contour.glsl"
};

}  // namespace geometry

using geometry::ExposedArc;

/// Balls that may cover parts of circles around one first ball.
class Blockers {
 public:
  /// Starts anew for circles of a first ball with this weight.
  void restart(double first_weight);
  /// center: relative to the first ball's.
  void add(const glm::dvec3& center, double weight, std::uint32_t label);

  /// Nearest first: near balls cover most, and a covered circle is done with.
  void sort();

  struct Ball : geometry::Blocker {
    std::uint32_t label;
  };
  std::size_t size() const { return balls_.size(); }
  const Ball& operator[](std::size_t n) const { return balls_[n]; }
  double first_weight() const { return first_weight_; }

 private:
  double first_weight_ = 0;
  std::vector<Ball> balls_;
};

/// A part of the circle that is covered whatever the balls say: dot(normal, (x, y)) > offset in the circle's frame.
struct BlockedHalf {
  geometry::HalfPlane half_plane;
  std::uint32_t label = 0;
};

/// What is left of one circle. Reused from circle to circle to save allocations.
class Contour {
 public:
  /// The circle of the blockers' first ball and the ball (d, w1) among them; the blocker at index `skip` is ignored.
  /// Afterwards: whole() = nothing covers any of it; else arcs() (possibly none), in no particular order.
  void expose(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
              std::span<const BlockedHalf> halves = {});

  bool whole() const { return left_.exposed_whole; }
  std::span<const ExposedArc> arcs() const { return {left_.exposed_arcs.data(), left_.exposed_count}; }
  const geometry::Circle& circle() const { return left_.contour_circle; }
  std::size_t doubtful_count() const { return doubtful_count_; }  ///< circles redone in quadruple precision so far

  /// Unit vector from the circle's centre at a pseudo-angle.
  glm::dvec3 direction(double pseudo) const {
    const glm::dvec2 e = geometry::direction_at(pseudo);
    return e.x * circle().u + e.y * circle().v;
  }

 private:
  void expose_in_double(const Blockers& blockers, std::size_t skip, std::span<const BlockedHalf> halves);
  void expose_in_quad(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                      std::span<const BlockedHalf> halves);

  geometry::Remainder left_;
  std::size_t doubtful_count_ = 0;
};

}  // namespace meniscus
