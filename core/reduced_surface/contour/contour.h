// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up: the exposed arcs of the circle of two balls among other balls (Totrov & Abagyan 1996), and their
// ties.
//
// The same code finds RS edges (balls = SAS balls of atoms) and the cusp curves of concave patches (balls = fixed
// probes). Decisions are taken in double with an error bound; a circle with a doubtful decision is done again in
// quadruple precision, where the decision weights (see reduced_surface.h) leave no ties.
#pragma once

#include "core/math/double_geometry.h"
#include "core/reduced_surface/contour/blockers.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Finds the balls whose caps of the first ball's sphere surely lie within the caps of others. Such a ball's circle is
/// covered, and it ends no arc of another circle. An object is reused from sphere to sphere.
class NestedCaps {
 public:
  /// Returns, per blocker, 1 if it can be left out. Each is compared only with the widest caps, so that the time is
  /// nearly proportional to the number of balls, and 0 proves nothing.
  const std::vector<std::uint8_t>& find(const Blockers& blockers);

 private:
  struct Cap {
    std::uint32_t ball;
    glm::dvec3 axis;
    double cosine, sine;
    double blur;  ///< radians: the possible error of its border
  };

  std::vector<Cap> caps_, widest_;
  std::vector<std::uint8_t> nested_;
};

namespace geometry {

/// The part of one circle that balls leave, in double precision.
struct Remainder {
  std::vector<ExposedArc> exposed_arcs;  ///< only the first exposed_count are valid
  const ExposedArc& get_arc(uint n) const { return exposed_arcs[n]; }
  bool set_arc(uint n, const ExposedArc& arc) {
    if (exposed_arcs.size() <= n) exposed_arcs.resize(n + 1);
    exposed_arcs[n] = arc;
    return true;
  }
#include "gpu_shaders/geometry/contour.glsl"
};

}  // namespace geometry

using geometry::ExposedArc;

/// A part of the circle that is covered independently of the balls: dot(normal, (x, y)) > offset in the circle's frame.
struct BlockedHalf {
  geometry::HalfPlane half_plane;
  std::uint32_t label = 0;
};

/// The exposed part of one circle. An object is reused from circle to circle to save allocations.
class Contour {
 public:
  /// unit: the relative error to assume for numbers in double precision; smaller differences are in doubt.
  explicit Contour(double unit = geometry::kUnitRoundoff) : unit_(unit) {}

  /// Finds the exposed part of the circle of the blockers' first ball and the ball (d, w1), which is among the
  /// blockers; the blocker at index `skip` is ignored. Afterwards whole() is true if nothing covers any of it; else
  /// arcs() has the exposed arcs, possibly none.
  void expose(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
              std::span<const BlockedHalf> halves = {});

  /// Finds the exposed part in double precision only. False if doubt remains: then nothing is known of the circle.
  bool expose_surely(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                     std::span<const BlockedHalf> halves = {});

  /// Does the same as expose(), faster where nothing or one arc is left.
  bool expose_at_once(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip);

  /// Applies one more ball to the circle of the last expose(). blockers: the same ones and one more.
  void expose_further(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip);

  bool whole() const { return left_.exposed_whole; }
  std::span<const ExposedArc> arcs() const { return {left_.exposed_arcs.data(), left_.exposed_count}; }
  const geometry::Circle& circle() const { return left_.contour_circle; }
  std::size_t doubtful_count() const { return doubtful_count_; }  ///< circles redone in quadruple precision so far

  /// Returns the unit vector from the circle's centre at a pseudo-angle.
  glm::dvec3 direction(double pseudo) const {
    const glm::dvec2 e = geometry::direction_at(pseudo);
    return e.x * circle().u + e.y * circle().v;
  }

  /// Returns the point of the circle at a pseudo-angle, relative to the first ball's centre.
  glm::dvec3 point(double pseudo) const {
    return circle().height * circle().axis + circle().radius * direction(pseudo);
  }

 private:
  bool begin_surely(const glm::dvec3& d, double w0, double w1);
  void cover_in_turn(const Blockers& blockers);
  bool conclude();
  void expose_in_quad(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                      std::span<const BlockedHalf> halves);

  double unit_;
  geometry::Remainder left_;
  CircleMeetings meetings_;
  CircleSweep sweep_;
  bool sure_ = true;  // true if the last circle was decided in double precision
  std::size_t doubtful_count_ = 0;
};

/// Decides circles a second time, for radii shrunk by as much as decisions grow them. A sign that is the same for both
/// is the same for the given radii, because within 1e-9 Å all deciding expressions are practically linear. An object is
/// reused from circle to circle.
class TieWatch {
 public:
  /// Compares the second decision with the result of expose() for a circle in doubt. blockers, skip: as in expose();
  /// first: index of the atom that the blockers surround; index_of(label): the index of another atom.
  template <typename IndexOf>
  void compare(const Contour& decided, const Blockers& blockers, std::size_t skip, std::uint32_t first,
               const IndexOf& index_of) {
    shrunk_.restart(shrunk_weight(blockers.first_weight(), first));
    for (std::size_t n = 0; n < blockers.size(); ++n) {
      const Blockers::Ball ball = blockers[n];
      shrunk_.add(ball.center, shrunk_weight(ball.weight, index_of(ball.label)), ball.label);
    }
    contour_.expose(shrunk_[skip].center, shrunk_[skip].weight, shrunk_, skip);
    if (!leave_the_same(decided, contour_)) ++ties_;
  }

  std::size_t ties() const { return ties_; }

 private:
  static bool leave_the_same(const Contour& a, const Contour& b) {
    const auto same = [](const ExposedArc& x, const ExposedArc& y) {
      return x.begin_by == y.begin_by && x.end_by == y.end_by;
    };
    return a.whole() == b.whole() && std::ranges::equal(a.arcs(), b.arcs(), same);
  }

  Blockers shrunk_;
  Contour contour_;
  std::size_t ties_ = 0;
};

}  // namespace meniscus
