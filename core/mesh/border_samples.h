// SPDX-License-Identifier: BSD-3-Clause
// Sample points on the borders of a surface: taken once and shared by the two faces of each border.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/triangle_mesh.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// How long edges may be and how far triangles may be from the surface, on spheres and tubes of any radius (Å): as
/// MeshOptions say.
class EdgeRule {
 public:
  /// long_strips: where a length is asked for, see is_strip().
  explicit EdgeRule(const MeshOptions& options, bool long_strips = true)
      : tolerance_(options.tolerance), edge_(options.edge), long_strips_(long_strips && edge_ > 0.0) {}
  /// As many as that only where arcs span more than this, radian.
  EdgeRule with_angle(double angle) const {
    EdgeRule rule = *this;
    rule.angle_ = angle;
    return rule;
  }

  /// The longest edge on a sphere of this radius. By tolerance: an equilateral triangle of edge h lies h^2/(6 r) below
  /// the sphere at most; a little is kept in hand.
  double edge(double radius) const;
  /// The same of a chord of a circle.
  double chord(double radius) const;
  /// Is a saddle with this tube so thin that edges along it are as long as those of its atoms? Else there would be as
  /// many as the tube is round, whatever the length.
  bool is_strip(double tube_radius) const {
    return long_strips_ && tube_radius > 0.0 && edge(tube_radius) < kStrip * edge_;
  }
  /// No step of an arc spans more, radian.
  double largest_angle() const;
  /// Into how many parts an arc of so many steps is cut: by tolerance none is longer than a step, by length each is as
  /// near to one as can be.
  int parts(double steps) const;
  double tolerance(double radius) const;

 private:
  static constexpr double kStrip = 0.25;

  double tolerance_, edge_;
  bool long_strips_;
  double angle_ = 0.9;  ///< radian: where a length is asked for, few long edges are wanted
};

/// The radius of the sphere or of the torus tube that a face lies on.
double tube_radius(const Surface& surface, const Face& face);

/// How far triangles of a face may be from it: of a strip as far as those of the larger atom.
double tolerance_of(const EdgeRule& rule, const Surface& surface, const Face& face);

/// Names a mesh vertex before vertices are numbered: a vertex of the surface, or a sample inside a border.
struct BorderPoint {
  std::uint32_t border = kNone;  ///< kNone: `index` is a vertex of the surface
  std::uint32_t index = 0;
  auto operator<=>(const BorderPoint&) const = default;
};

class BorderSamples {
 public:
  /// With `split_colors`, points where the nearest contact of a face changes are samples too.
  BorderSamples(const Surface& surface, const EdgeRule& rule, bool split_colors);

  /// 0 for a border so short that its two ends have become one vertex.
  std::uint32_t segment_count(std::uint32_t border) const;
  /// The point at the start of segment k; k = segment_count gives the end (for a whole circle: the start again).
  BorderPoint point(std::uint32_t border, std::uint32_t k) const;
  /// The curve parameter t of that point, in [0, sweep].
  double parameter(std::uint32_t border, std::uint32_t k) const;
  glm::dvec3 position(std::uint32_t border, std::uint32_t k) const;
  glm::dvec3 position(BorderPoint point) const;
  /// The vertex that stands for this one after ends of zero-length borders have been joined.
  std::uint32_t representative(std::uint32_t vertex) const;
  /// Halves a segment.
  void split(std::uint32_t border, std::uint32_t segment);
  /// The borders of which segments were halved since this was asked last, some of them several times.
  std::vector<std::uint32_t> take_split() { return std::exchange(split_, {}); }

 private:
  void join_ends_of_tiny_borders();
  void sample(std::uint32_t border, const EdgeRule& rule, bool split_colors);

  const Surface& surface_;
  std::vector<std::uint32_t> representative_;
  std::vector<std::vector<double>> parameters_;  ///< per border, ascending from 0; arcs end with their sweep
  std::vector<std::uint32_t> split_;             ///< of take_split()
};

}  // namespace meniscus
