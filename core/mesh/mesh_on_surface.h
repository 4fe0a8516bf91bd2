// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose vertices lie on an exact surface and move along it during remeshing, and the quality of its
// triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/mesh_crossings.h"
#include "core/mesh/surface_walk.h"

namespace meniscus {

struct TriangleMesh;

/// What a vertex of a mesh on a surface has beside its position.
struct MeshVertex {
  glm::dvec3 normal{0.0};        ///< of the surface
  std::uint32_t face = kNone;    ///< of the surface
  std::uint32_t crease = kNone;  ///< the border that it moves along, or kNone
  float size = 0.0f;             ///< Å, edges wanted around it
  float scale = 1.0f;            ///< what refinements made of that
  float least_cosine = 0.0f;     ///< triangles whose normals have a smaller one with the vertex's are folded over
  bool pinned = false;           ///< stays: creases end or meet here, or it was put here for good
  bool frozen = false;           ///< stays, as edges between two such ones do, but for mending
  bool active = true;            ///< passes change what is around it
  bool changed = true;           ///< since nearness was asked last
  bool unchecked = true;         ///< since crossings were searched for last

  void note_change() { changed = unchecked = true; }

  /// The surface has no single normal here.
  bool on_crease() const { return crease != kNone || pinned; }
};

/// What a quality falls by if the triangle is folded over.
inline constexpr double kFold = 2.0;

/// Of some triangles how many are folded over, and the worst quality.
class WorstQuality {
 public:
  void add(double quality) {
    if (quality < 0.0) ++folded_, quality += kFold;
    worst_ = std::min(worst_, quality);
  }
  /// The more the better; folds count before anything else.
  double score() const { return worst_ - folded_; }

 private:
  int folded_ = 0;
  double worst_ = 1.0;
};

/// Qualities of triangles, remembered as long as nothing around them changes.
class TriangleQuality {
 public:
  /// All three have to live as long.
  TriangleQuality(const HalfEdges& links, const std::vector<glm::dvec3>& positions,
                  const std::vector<MeshVertex>& vertices)
      : links_(links), positions_(positions), vertices_(vertices) {
    make_room();
  }

  /// Of a triangle of these vertices, the first of them at x; less kFold if it is folded over.
  double of(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const;
  /// The same of a triangle as it is.
  double of(std::uint32_t triangle) const;
  /// Of all triangles around a vertex; as if it were at x.
  double score_around(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  /// Finds and remembers all of them.
  void find_all();
  void remember(std::uint32_t triangle, double quality) { known_[triangle] = static_cast<float>(quality); }
  void forget(std::uint32_t triangle) { known_[triangle] = kUnknown, stale_[triangle] = 1; }
  void forget_all();
  /// Marks what has to be asked again whether its edges should be flipped.
  void make_stale(std::uint32_t triangle) { stale_[triangle] = 1; }
  /// Per triangle whether it was stale; none is from now on.
  std::vector<std::uint8_t> take_stale();
  /// For triangles that were added.
  void make_room();
  /// Before HalfEdges::compact().
  void compact();

 private:
  static constexpr float kUnknown = 9.0f;
  bool is_folded(std::uint32_t vertex, const glm::dvec3& normal, double size) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  const std::vector<MeshVertex>& vertices_;
  std::vector<float> known_;  ///< per triangle, or kUnknown
  std::vector<std::uint8_t> stale_;
};

/// The edge length (Å) wanted at a place of a face.
using EdgeLength = std::function<double(const SurfacePoint&)>;

/// Changes keep the numbers of vertices and triangles, what is known of qualities, and the guard in step. Whether they
/// may be made is for others to ask.
class MeshOnSurface {
 public:
  /// base: closed, its vertices on the surface; vertex_face: per vertex a face that it lies on. keep: per border of the
  /// surface, whether edges follow it; the walk is barred from crossing those. The surface and the walk have to live as
  /// long.
  MeshOnSurface(const Surface& surface, SurfaceWalk& walk, const TriangleMesh& base,
                std::span<const std::uint32_t> vertex_face, const std::vector<bool>& keep, EdgeLength edge);
  MeshOnSurface(const MeshOnSurface&) = delete;
  MeshOnSurface& operator=(const MeshOnSurface&) = delete;

  const Surface& surface() const { return surface_; }
  const SurfaceWalk& walk() const { return walk_; }
  const HalfEdges& links() const { return links_; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  const MeshVertex& vertex(std::uint32_t vertex) const { return vertices_[vertex]; }
  MeshVertex& vertex(std::uint32_t vertex) { return vertices_[vertex]; }
  SurfacePoint point(std::uint32_t vertex) const { return {positions_[vertex], vertices_[vertex].face}; }
  double length(std::uint32_t half) const {
    return glm::distance(positions_[links_.from(half)], positions_[links_.to(half)]);
  }
  /// The length (Å) wanted of an edge.
  double wanted(std::uint32_t half) const {
    return 0.5 * (vertices_[links_.from(half)].size + vertices_[links_.to(half)].size);
  }
  /// Has its component more vertices than it needs?
  bool can_spare(std::uint32_t vertex) const;
  PlacedTriangle placed(std::uint32_t triangle) const { return guard_.placed(triangle); }
  TriangleQuality& quality() { return quality_; }
  const TriangleQuality& quality() const { return quality_; }
  CrossingGuard& guard() { return guard_; }
  const CrossingGuard& guard() const { return guard_; }

  /// Puts a vertex elsewhere; what is known of the triangles around it is left to the caller.
  void place(std::uint32_t vertex, const SurfacePoint& at);
  void move(std::uint32_t vertex, const SurfacePoint& at);
  void split(std::uint32_t half, const SurfacePoint& at);
  void poke(std::uint32_t triangle, const SurfacePoint& at);
  void collapse(std::uint32_t half);
  void flip(std::uint32_t half);
  /// Of triangles whose new qualities are known: that of the half-edge's, and that of its twin's.
  void flip(std::uint32_t half, const std::array<double, 2>& qualities);
  /// Takes the places of vertices and triangles that are gone.
  void compact();

  /// From now on triangles lean as they have to, or as little as the edges wanted let them.
  void let_lean(bool as_they_have_to);
  /// Asks for shorter or longer edges around a vertex; what is known of qualities is left to the caller.
  void scale_size(std::uint32_t vertex, float factor);

 private:
  void settle(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t crease);
  void add_vertex(std::uint32_t a, std::uint32_t b, const SurfacePoint& at, std::uint32_t crease);
  void note_changes_around(std::uint32_t vertex);
  float least_cosine(std::uint32_t vertex) const;
  std::uint32_t component(std::uint32_t vertex) const;

  const Surface& surface_;
  const SurfaceWalk& walk_;
  EdgeLength edge_;
  bool may_lean_ = false;
  HalfEdges links_;
  std::vector<glm::dvec3> positions_;
  std::vector<MeshVertex> vertices_;
  std::vector<std::uint32_t> vertex_count_;  ///< per component
  TriangleQuality quality_{links_, positions_, vertices_};
  CrossingGuard guard_{links_, positions_};
};

}  // namespace meniscus
