// SPDX-License-Identifier: BSD-3-Clause
// The mesh while it is made even: its vertices on the surface, their sizes, and one pass of each kind over it.
#pragma once

#include <algorithm>
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
  /// base: of tessellate() or coarse_mesh(), all faces. keep: per border of the surface, whether edges follow it; the
  /// walk is barred from crossing those. frozen: per face of the surface, whether its triangles stay as they are. The
  /// surface and the walk have to live as long.
  Evener(const Surface& surface, SurfaceWalk& walk, const TriangleMesh& base, const std::vector<bool>& keep,
         const std::vector<bool>& frozen, EdgeLength edge);

  /// Splits and collapses until few edges are too long or too short.
  void approach();
  /// Splits long edges, collapses short ones, flips and relaxes, `rounds` times.
  void even_out(int rounds);
  /// Improves triangles with small angles one by one.
  void mend();
  /// Asks for edges shorter by `factor` around these triangles, and confines what follows to their neighbourhood.
  void refine(const std::vector<std::uint32_t>& triangles, double factor);
  /// Vertices in these balls stay where they are from now on, and edges between them.
  void hold(const std::vector<Ball>& places);
  /// Nothing is held or frozen from now on.
  void release();
  /// Takes the places of vertices and triangles that are gone.
  void compact();

  const LinkedTriangles& links() const { return links_; }
  const std::vector<glm::dvec3>& positions() const { return position_; }
  SurfacePoint point(std::uint32_t vertex) const { return {position_[vertex], face_[vertex]}; }
  /// On a crease, or where several meet: the surface has no single normal there.
  bool on_crease(std::uint32_t vertex) const { return border_[vertex] != kNone || pinned_[vertex]; }

 private:
  /// What some triangles look like.
  struct Looks {
    int inwards = 0;     ///< triangles that are folded over
    double worst = 1.0;  ///< the least quality
    void add(double look) {
      if (look < 0.0) ++inwards, look += kFold;
      worst = std::min(worst, look);
    }
    /// The more the better; folds count before anything else.
    double score() const { return worst - inwards; }
  };
  /// What a look falls by if the triangle is folded over.
  static constexpr double kFold = 2.0;

  void mark_creases(const TriangleMesh& base, const std::vector<bool>& keep);
  void pin_corners();
  std::uint32_t crease_of(const glm::dvec3& a, const glm::dvec3& b, std::uint32_t face,
                          const std::vector<bool>& keep) const;
  void settle(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t border);

  /// Edges longer than this times the length wanted; how many.
  std::uint32_t split_long(double limit);
  bool split(std::uint32_t half);
  std::uint32_t collapse_short();
  bool try_collapse(std::uint32_t half, bool for_quality);
  bool may_vanish(std::uint32_t half) const;
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();
  std::optional<SurfacePoint> relaxed(std::uint32_t vertex) const;
  std::optional<glm::dvec3> centroid_along_crease(std::uint32_t vertex) const;
  glm::dvec3 centroid_around(std::uint32_t vertex) const;
  bool nudge(std::uint32_t vertex);

  bool frozen_edge(std::uint32_t half) const { return frozen_[links_.from(half)] && frozen_[links_.to(half)]; }
  bool busy(std::uint32_t half) const {
    return (active_[links_.from(half)] || active_[links_.to(half)]) && !frozen_edge(half);
  }
  double wanted(std::uint32_t half) const { return 0.5 * (size_[links_.from(half)] + size_[links_.to(half)]); }
  double length(std::uint32_t half) const;
  /// The quality of a triangle of these vertices, the first of them standing at x; less kFold if it leans over.
  double look(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const;
  bool leans_over(std::uint32_t vertex, const glm::dvec3& normal, double size) const;
  /// The same of a triangle as it is, from memory if nothing of it changed.
  double look_of(std::uint32_t triangle) const;
  void forget_looks_around(std::uint32_t vertex);
  void look_at_all();
  void settle_outlooks();
  double least_outlook(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  const Surface& surface_;
  bool approaching_ = false;  ///< triangles are still coarser than wanted, and lean as they have to
  const SurfaceWalk& walk_;
  EdgeLength edge_;
  LinkedTriangles links_;
  // per vertex
  std::vector<glm::dvec3> position_, normal_;
  std::vector<std::uint32_t> face_;    ///< of the surface
  std::vector<std::uint32_t> border_;  ///< of the crease that it moves along, or kNone
  std::vector<std::uint8_t> pinned_;   ///< where creases end or meet
  std::vector<float> size_;            ///< Å, edges wanted around it
  std::vector<float> scale_;           ///< what refinements made of that
  std::vector<float> outlook_;         ///< least_outlook()
  std::vector<std::uint8_t> active_, frozen_;
  std::vector<float> look_;  ///< per triangle; kUnseen where something changed
};

}  // namespace meniscus
