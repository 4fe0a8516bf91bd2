// SPDX-License-Identifier: BSD-3-Clause
// An oracle for the solvent-excluded surface that knows nothing but the balls: distance to the accessible region, and
// rays found by sphere tracing that distance.
//
// Definition used (Connolly 1983): the accessible region A is where the probe's centre can be, that is, the complement
// of the union of the balls B(c_i, r_i + p). The surface is { x : dist(x, A) = p } and its solid { x : dist(x, A) >= p
// }. The point of A nearest to x is the projection of x on a sphere, the point of a circle of two spheres nearest to x,
// or a point where three spheres meet. All of these are tried by brute force and kept when no ball covers them: no
// reduced surface, no patches, no order of arcs, no code of core/surface. Sphere tracing: J. C. Hart 1996. The steps
// are safe because dist(., A) has Lipschitz constant 1.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus::testing {

/// The point of the accessible region's border nearest to some point.
struct NearestProbe {
  double distance = 0.0;                                   ///< Å; capped at SphereTracer::reach()
  glm::dvec3 center{0.0};                                  ///< a nearest probe position; only when distance < reach()
  PatchKind kind = PatchKind::convex;                      ///< touches one atom: convex, two: toroidal, three: concave
  std::array<std::uint32_t, 3> atom{kNone, kNone, kNone};  ///< the touched atoms, ascending, filled up with kNone
};

/// Where a ray enters the solid.
struct TraceHit {
  double t = 0.0;  ///< Å along the ray
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  ///< unit, towards the solvent: (probe - point)/p, for p = 0 the sphere's normal
  NearestProbe probe;
};

/// Everything is double precision and O(1) a query after a grid has been built, of about 1 Å or an eighth of the reach.
class SphereTracer {
 public:
  /// balls: vdW balls, any number, any degeneracy; probe_radius >= 0 in Å.
  /// `margin` is the distance beyond probe_radius up to which nearest() measures.
  SphereTracer(std::span<const Ball> balls, double probe_radius, double margin = 0.25);

  /// Returns probe_radius + margin, below which distances are exact.
  double reach() const { return reach_; }

  /// Returns dist(x, A), capped at reach(); 0 when x is in A. x is on the surface where this equals probe_radius
  /// (p > 0). Accuracy about 1e-13 Å; where four or more spheres meet within 1e-9 Å, about 1e-5 Å.
  NearestProbe nearest(const glm::dvec3& x) const;

  /// Returns the signed distance to the union of the balls B(c_i, r_i + p) where x is outside of it (> 0), capped at
  /// reach(); <= 0 inside.
  double outside(const glm::dvec3& x) const;

  /// Returns the first point of the solid on origin + t * direction, t in [0, t_max], to `tolerance` Å of distance.
  /// direction has unit length. A ray that starts inside the solid hits at t = 0.
  std::optional<TraceHit> trace(const glm::dvec3& origin, const glm::dvec3& direction, double t_max = 1e6,
                                double tolerance = 1e-9) const;

 private:
  struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 0.0;
    bool exposed = false;
    std::uint32_t first_blocker = 0, blocker_count = 0;
  };
  struct Circle {
    glm::dvec3 center{0.0}, axis{0.0};
    double radius = 0.0;
    std::array<std::uint32_t, 2> atom{};
    std::uint32_t first_blocker = 0, blocker_count = 0;
  };
  struct Vertex {
    glm::dvec3 center{0.0};
    std::array<std::uint32_t, 3> atom{};
  };
  /// Items within reach of every grid cell.
  struct CellList {
    std::vector<std::uint32_t> first, item;
    std::span<const std::uint32_t> at(std::size_t cell) const;
  };

  void find_blockers();
  void find_circle(std::uint32_t i, std::uint32_t j);
  void find_exposed_spheres();
  void build_grid();
  template <class Visit>
  void visit_cells(const glm::dvec3& low, const glm::dvec3& high, Visit visit) const;
  CellList fill_cells(std::size_t count, const auto& extent, const auto& distance) const;
  bool covered(const glm::dvec3& x, std::span<const std::uint32_t> blockers, std::uint32_t skip_a,
               std::uint32_t skip_b) const;
  std::optional<std::size_t> cell_of(const glm::dvec3& x) const;
  double cell_exit(const glm::dvec3& x, const glm::dvec3& direction) const;

  double probe_radius_, reach_;
  std::vector<Sphere> spheres_;
  std::vector<Circle> circles_;  ///< only those with an exposed point
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> sphere_blockers_, circle_blockers_;

  glm::dvec3 grid_low_{0.0};
  double cell_size_ = 1.0;
  glm::ivec3 cells_{0};
  CellList sphere_cells_, circle_cells_, vertex_cells_;
};

}  // namespace meniscus::testing
