// SPDX-License-Identifier: BSD-3-Clause
// Sample points on the borders of a surface, taken once and shared by the two faces of each border.
#pragma once

#include <utility>

#include "core/mesh/triangle_mesh.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The edge lengths and the distances from the surface that MeshOptions permit, on spheres and tubes of any radius (Å).
class EdgeRule {
 public:
  /// `long_strips` enables is_strip(), which applies only to options with an edge length.
  explicit EdgeRule(const MeshOptions& options, bool long_strips = true)
      : tolerance_(options.tolerance), edge_(options.edge), long_strips_(long_strips && edge_ > 0.0) {}
  /// Returns this rule with another limit (radian) of the angle that an edge of a requested length may span.
  EdgeRule with_angle(double angle) const {
    EdgeRule rule = *this;
    rule.angle_ = angle;
    return rule;
  }

  /// Returns the longest edge (Å) on a sphere of this radius (Å). By tolerance: an equilateral triangle with edge h
  /// lies at most h^2/(6 r) below the sphere, and a small safety margin is kept.
  double edge(double radius) const;
  /// Returns the longest chord (Å) of a circle of this radius (Å).
  double chord(double radius) const;
  /// True if a saddle with a tube of this radius (Å) is so thin that edges along it are as long as the edges on its
  /// atoms. Otherwise the curvature of the tube would force short edges along it, whatever length was requested.
  bool is_strip(double tube_radius) const {
    return long_strips_ && tube_radius > 0.0 && edge(tube_radius) < kStrip * edge_;
  }
  /// Returns the largest angle (radian) that one step of an arc may span.
  double largest_angle() const;
  /// Returns the number of parts that an arc of this many steps is cut into. By tolerance no part is longer than a
  /// step; by length the parts are as close to a step as possible.
  int parts(double steps) const;
  /// Returns how far (Å) triangles on a sphere or tube of this radius (Å) may be from it.
  double tolerance(double radius) const;

 private:
  static constexpr double kStrip = 0.25;

  double tolerance_, edge_;
  bool long_strips_;
  double angle_ = 0.9;  ///< largest angle (radian) of an edge of a requested length, which keeps edges few and long
};

/// Returns the radius (Å) of the sphere or of the torus tube that a face lies on.
double tube_radius(const Surface& surface, const Face& face);

/// Returns how far (Å) the triangles of a face may be from it. On a strip this is the tolerance of the larger atom.
double tolerance_of(const EdgeRule& rule, const Surface& surface, const Face& face);

/// Identifies a mesh vertex before vertices are numbered: a vertex of the surface, or a sample inside a border.
struct BorderPoint {
  std::uint32_t border = kNone;  ///< kNone if `index` is a vertex of the surface
  std::uint32_t index = 0;
  auto operator<=>(const BorderPoint&) const = default;
};

/// The samples on all borders of a surface, which must outlive them.
class BorderSamples {
 public:
  /// With `split_colors`, points where the nearest contact of a face changes are samples, too.
  BorderSamples(const Surface& surface, const EdgeRule& rule, bool split_colors);

  /// Returns the number of segments of a border; 0 if it is so short that its two ends have become one vertex.
  std::uint32_t segment_count(std::uint32_t border) const;
  /// Returns the point at the start of segment k. For k = segment_count() it is the end of the border, which on a whole
  /// circle is the start again.
  BorderPoint point(std::uint32_t border, std::uint32_t k) const;
  /// Returns the curve parameter t (radian) of that point, in [0, sweep].
  double parameter(std::uint32_t border, std::uint32_t k) const;
  glm::dvec3 position(std::uint32_t border, std::uint32_t k) const;
  glm::dvec3 position(BorderPoint point) const;
  /// Returns the vertex that replaces this one after the ends of zero-length borders have been joined.
  std::uint32_t representative(std::uint32_t vertex) const;
  /// Halves a segment at the middle of its parameter range.
  void split(std::uint32_t border, std::uint32_t segment);
  /// Returns the borders with segments that were halved since the last call; a border may occur several times.
  std::vector<std::uint32_t> take_split() { return std::exchange(split_, {}); }

 private:
  void join_ends_of_tiny_borders();
  void sample(std::uint32_t border, const EdgeRule& rule, bool split_colors);

  const Surface& surface_;
  std::vector<std::uint32_t> representative_;
  /// Per border: curve parameters, ascending from 0; on an arc the last one is its sweep.
  std::vector<std::vector<double>> parameters_;
  std::vector<std::uint32_t> split_;  ///< the borders that take_split() returns next
};

}  // namespace meniscus
