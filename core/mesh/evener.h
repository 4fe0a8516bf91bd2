// SPDX-License-Identifier: BSD-3-Clause
// The mesh while it is made even: its vertices on the surface, their sizes, and one pass of each kind over it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/crossing_guard.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/surface_walk.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// The edge length (Å) wanted at a place of a face.
using EdgeLength = std::function<double(const SurfacePoint&)>;
/// Whether a triangle may be made.
using Allowed = std::function<bool(const PlacedTriangle&)>;

class Evener {
 public:
  /// A point of the surface that is near a triangle.
  struct Place {
    std::uint32_t triangle = kNone;
    SurfacePoint at;
  };

  /// base: closed, its vertices on the surface; vertex_face: per vertex a face that it lies on. keep: per border of the
  /// surface, whether edges follow it; the walk is barred from crossing those. The surface and the walk have to live as
  /// long.
  Evener(const Surface& surface, SurfaceWalk& walk, const TriangleMesh& base, std::vector<std::uint32_t> vertex_face,
         const std::vector<bool>& keep, EdgeLength edge);
  Evener(const Evener&) = delete;
  Evener& operator=(const Evener&) = delete;

  /// From now on nothing that is done in these balls lets triangles pass through others.
  void watch(std::span<const Ball> places);
  /// What is watched stays as it is, but for mending.
  void hold_watched() { held_ = watched_; }

  /// Splits and collapses until few edges are too long or too short.
  void approach();
  /// Splits long edges, collapses short ones, flips and relaxes, `rounds` times.
  void even_out(int rounds);
  /// Changes these triangles, and those with small angles, one by one until they pass through no others, are allowed
  /// and have larger angles, wherever one flip, collapse, split or move does that. No others come to cross or to be
  /// forbidden.
  void mend(std::span<const std::uint32_t> triangles, const Allowed& allowed);
  /// Asks for edges shorter by `factor` around these triangles, and confines what follows to their neighbourhood.
  void refine(const std::vector<std::uint32_t>& triangles, double factor);
  /// Puts vertices there, or moves some, where nothing comes to cross by that; they stay there.
  void reach(std::span<const Place> places, const Allowed& allowed);
  /// Takes the places of vertices and triangles that are gone.
  void compact();

  const HalfEdges& links() const { return links_; }
  const std::vector<glm::dvec3>& positions() const { return position_; }
  SurfacePoint point(std::uint32_t vertex) const { return {position_[vertex], face_[vertex]}; }
  /// May the triangle have changed since forget_changes()?
  bool changed(std::uint32_t triangle) const {
    const auto v = links_.corners(triangle);
    return changed_[v[0]] || changed_[v[1]] || changed_[v[2]];
  }
  /// But for those of these triangles.
  void forget_changes(std::span<const Place> but);
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
  /// A look that was not taken.
  static constexpr float kUnseen = 9.0f;
  /// Collapses and moves of vertices make no worse triangles than that.
  static constexpr double kPoor = 0.3;
  /// Cosines between the normals of a triangle and of the surface at its vertices: the least asked for.
  static constexpr double kSteepest = 0.05;

  void mark_creases(const TriangleMesh& base, const std::vector<bool>& keep);
  void pin_corners();
  std::uint32_t crease_of(const glm::dvec3& a, const glm::dvec3& b, std::uint32_t face,
                          const std::vector<bool>& keep) const;
  void settle(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t border);

  /// Edges longer than this times the length wanted; how many.
  std::uint32_t split_long(double limit);
  bool split(std::uint32_t half);
  std::optional<SurfacePoint> middle_of(std::uint32_t half) const;
  void put_vertex(std::uint32_t half, const SurfacePoint& at);
  void poke(std::uint32_t triangle, const SurfacePoint& at);
  void add_vertex(std::uint32_t a, std::uint32_t b, const SurfacePoint& at, std::uint32_t border);
  std::uint32_t collapse_short();
  bool try_collapse(std::uint32_t half);
  bool may_vanish(std::uint32_t half) const;
  bool may_merge(std::uint32_t half) const;
  bool is_too_short(std::uint32_t half) const;
  bool stays_short(std::uint32_t half) const;
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();
  std::optional<SurfacePoint> relaxed(std::uint32_t vertex) const;
  std::optional<glm::dvec3> centroid_along_crease(std::uint32_t vertex) const;
  glm::dvec3 centroid_around(std::uint32_t vertex) const;

  /// A change of a few triangles that has not been made.
  struct Change {
    enum class Kind : std::uint8_t { flip, collapse, split, poke, move };
    Kind kind = Kind::flip;
    std::uint32_t where = kNone;  ///< a half-edge; of a poke the triangle, of a move the vertex
    SurfacePoint at;              ///< of the latter three: where the vertex comes
  };
  /// The triangles that it makes and those that it takes away.
  struct Exchange {
    std::vector<PlacedTriangle> made;
    std::vector<std::uint32_t> gone;
  };
  /// Scores that differ less are the same, or changes would be made back and forth for ever.
  static constexpr double kBetter = 1e-6;

  template <typename Visit>
  void each_made(const Change& change, const Visit& visit) const;
  template <typename Visit>
  void each_gone(const Change& change, const Visit& visit) const;
  Exchange exchange(const Change& change) const;
  bool is_free(const Change& change) const;
  /// The vertex that a change makes or moves.
  struct Newcomer {
    std::uint32_t vertex = kNone;
    glm::dvec3 normal{0.0};
    double outlook = 0.0;
    bool on_crease = false;
  };
  double score_after(const Change& change, bool steep, double bar = -std::numeric_limits<double>::infinity()) const;
  double score_before(const Change& change, bool steep) const;
  double look(const PlacedTriangle& triangle, const Newcomer& newcomer, bool steep) const;
  std::ptrdiff_t fewer_crossings(const Exchange& exchange) const;
  void make(const Change& change);
  bool is_wrong(std::uint32_t triangle, const Allowed& allowed) const;
  bool improve(std::uint32_t triangle, bool wrong, const Allowed& allowed);
  std::ptrdiff_t fewer_forbidden(const Exchange& exchange, const Allowed& allowed) const;
  template <typename Visit>
  void each_change(std::uint32_t triangle, bool steep, const Visit& visit) const;
  template <typename Visit>
  void each_place_near(std::uint32_t vertex, const Visit& visit) const;
  void watch_around(std::span<const std::uint32_t> triangles);
  void watch_no_longer();
  void mark_watched(std::span<const Ball> places, std::uint8_t kind);

  PlacedTriangle placed(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return {{a, b, c}, {position_[a], position_[b], position_[c]}};
  }
  void note_changes_around(std::uint32_t vertex);

  bool busy(std::uint32_t half) const {
    const std::uint32_t a = links_.from(half), b = links_.to(half);
    return (active_[a] || active_[b]) && !(held_[a] && held_[b]);
  }
  double wanted(std::uint32_t half) const { return 0.5 * (size_[links_.from(half)] + size_[links_.to(half)]); }
  double length(std::uint32_t half) const;
  /// The quality of a triangle of these vertices, the first of them standing at x; less kFold if it leans over.
  double look(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const;
  bool leans_over(std::uint32_t vertex, const glm::dvec3& normal, double size) const;
  /// The same of a triangle as it is, from memory if nothing of it changed.
  double look_of(std::uint32_t triangle) const;
  void look_at_all();
  void forget_looks();
  void settle_outlooks();
  double least_outlook(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  const Surface& surface_;
  bool approaching_ = false;  ///< triangles are still coarser than wanted, and lean as they have to
  const SurfaceWalk& walk_;
  EdgeLength edge_;
  HalfEdges links_;
  // per vertex
  std::vector<glm::dvec3> position_, normal_;
  std::vector<std::uint32_t> face_;    ///< of the surface
  std::vector<std::uint32_t> border_;  ///< of the crease that it moves along, or kNone
  std::vector<std::uint8_t> pinned_;   ///< where creases end or meet
  std::vector<float> size_;            ///< Å, edges wanted around it
  std::vector<float> scale_;           ///< what refinements made of that
  std::vector<float> outlook_;         ///< least_outlook()
  std::vector<std::uint8_t> active_, changed_;
  std::vector<std::uint8_t> watched_, held_;  ///< where the guard is asked; where nothing is done but mending
  // per triangle
  std::vector<float> look_;          ///< kUnseen where something changed
  std::vector<std::uint8_t> stale_;  ///< changed since its edges were last asked to flip
  CrossingGuard guard_{links_, position_};
};

}  // namespace meniscus
