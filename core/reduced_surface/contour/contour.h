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

/// Balls that may cover parts of circles around one first ball.
class Blockers {
 public:
  /// Starts anew for circles of a first ball with this weight.
  void restart(double first_weight);
  /// center: relative to the first ball's.
  void add(const glm::dvec3& center, double weight, std::uint32_t label);

  /// Nearest first: near balls cover most, and a covered circle is done with.
  void sort();

  struct Ball {
    glm::dvec3 center;
    double square;      ///< of the distance
    double half_power;  ///< (first weight + square - weight) / 2: dot(x, center) beyond which x is covered
    double distance;
    double weight;
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

/// An exposed arc in pseudo-angles of the circle's frame, and who covers the circle before and after.
struct ExposedArc {
  double begin = 0.0;
  double end = 0.0;
  std::uint32_t begin_by = 0;
  std::uint32_t end_by = 0;
};

/// What is left of one circle. Reused from circle to circle to save allocations.
class Contour {
 public:
  /// The circle of the blockers' first ball and the ball (d, w1) among them; the blocker at index `skip` is ignored.
  /// Afterwards: whole() = nothing covers any of it; else arcs() (possibly none), in no particular order.
  void expose(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
              std::span<const BlockedHalf> halves = {});

  bool whole() const { return whole_; }
  const std::vector<ExposedArc>& arcs() const { return arcs_; }
  const geometry::Circle& circle() const { return circle_; }
  std::size_t doubtful_count() const { return doubtful_count_; }  ///< circles redone in quadruple precision so far

  /// Unit vector from the circle's centre at a pseudo-angle.
  glm::dvec3 direction(double pseudo) const {
    const glm::dvec2 e = geometry::direction_at(pseudo);
    return e.x * circle_.u + e.y * circle_.v;
  }

 private:
  bool expose_in_double(const Blockers& blockers, std::size_t skip, std::span<const BlockedHalf> halves);
  void expose_in_quad(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                      std::span<const BlockedHalf> halves);

  geometry::Circle circle_;
  bool whole_ = false;
  std::vector<ExposedArc> arcs_;
  std::size_t doubtful_count_ = 0;
};

}  // namespace meniscus
