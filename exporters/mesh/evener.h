// SPDX-License-Identifier: BSD-3-Clause
// The mesh while it is made even: its vertices on the surface, their sizes, and one pass of each kind over it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "exporters/mesh/linked_triangles.h"
#include "exporters/mesh/surface_walk.h"
#include "exporters/mesh/triangle_mesh.h"

namespace meniscus {

/// The edge length (Å) wanted at a place of a face.
using EdgeLength = std::function<double(const SurfacePoint&)>;

class Evener {
 public:
  /// base: of tessellate(), all faces. keep: per border of the surface, whether edges follow it.
  Evener(const Surface& surface, const TriangleMesh& base, const std::vector<bool>& keep, EdgeLength edge);

  /// Splits long edges, collapses short ones, flips and relaxes, `rounds` times.
  void even_out(int rounds);
  /// Improves triangles with small angles one by one.
  void mend();
  /// Asks for edges shorter by `factor` around these triangles, and confines what follows to their neighbourhood.
  void refine(const std::vector<std::uint32_t>& triangles, double factor);
  /// Takes the places of vertices and triangles that are gone.
  void compact();

  const LinkedTriangles& links() const { return links_; }
  const SurfaceWalk& walk() const { return walk_; }
  const std::vector<glm::dvec3>& positions() const { return position_; }
  SurfacePoint point(std::uint32_t vertex) const { return {position_[vertex], face_[vertex]}; }
  /// On a crease, or where several meet: the surface has no single normal there.
  bool on_crease(std::uint32_t vertex) const { return border_[vertex] != kNone || pinned_[vertex]; }

 private:
  using Corners = std::array<glm::dvec3, 3>;
  /// What some triangles look like, of which a vertex, in place k, stands at x.
  struct Looks {
    int inwards = 0;     ///< triangles that are folded over
    double worst = 1.0;  ///< the least quality
    void add(const Evener& mesh, const std::array<std::uint32_t, 3>& v, int k, const glm::dvec3& x);
    /// The more the better; folds count before anything else.
    double score() const { return worst - inwards; }
  };

  void mark_creases(const TriangleMesh& base, const std::vector<bool>& keep);
  void pin_corners();
  std::uint32_t crease_of(const glm::dvec3& a, const glm::dvec3& b, std::uint32_t face,
                          const std::vector<bool>& keep) const;
  void settle(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t border);

  void split_long();
  void split(std::uint32_t half);
  void collapse_short();
  bool try_collapse(std::uint32_t half, bool for_quality);
  bool may_vanish(std::uint32_t half) const;
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();
  std::optional<SurfacePoint> relaxed(std::uint32_t vertex) const;
  std::optional<glm::dvec3> centroid_along_crease(std::uint32_t vertex) const;
  glm::dvec3 centroid_around(std::uint32_t vertex) const;
  bool nudge(std::uint32_t vertex);

  bool busy(std::uint32_t half) const { return active_[links_.from(half)] || active_[links_.to(half)]; }
  double wanted(std::uint32_t half) const { return 0.5 * (size_[links_.from(half)] + size_[links_.to(half)]); }
  double length(std::uint32_t half) const;
  Corners corners(std::uint32_t triangle) const;
  /// Does a triangle of these vertices, the one in place k standing at x, look outwards?
  bool looks_out(const std::array<std::uint32_t, 3>& v, int k, const glm::dvec3& x) const;
  double least_outlook(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  const Surface& surface_;
  SurfaceWalk walk_;
  EdgeLength edge_;
  LinkedTriangles links_;
  // per vertex
  std::vector<glm::dvec3> position_, normal_;
  std::vector<std::uint32_t> face_;    ///< of the surface
  std::vector<std::uint32_t> border_;  ///< of the crease that it moves along, or kNone
  std::vector<std::uint8_t> pinned_;   ///< where creases end or meet
  std::vector<float> size_;            ///< Å, edges wanted around it
  std::vector<float> scale_;           ///< what refinements made of that
  std::vector<std::uint8_t> active_;
};

/// 1 for an equilateral triangle, 0 for one without area: 4 sqrt(3) area / sum of squared edges.
double triangle_quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace meniscus
