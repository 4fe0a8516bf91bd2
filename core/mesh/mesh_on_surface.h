// SPDX-License-Identifier: BSD-3-Clause
// A mesh with vertices that lie on an exact surface and move along it during remeshing, the creases of the surface that
// its edges follow, and the quality of its triangles.
#pragma once

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/mesh_crossings.h"
#include "core/mesh/surface_walk.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct TriangleMesh;

/// Returns the unit normals on both sides of a border at its point x. They differ on a cusp between the spheres of two
/// probes and, if the probe radius is 0, between two balls. For other borders, where the tangent planes agree, both are
/// the zero vector.
std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x);

/// Returns the angle (radian) between the two normals, which is the same all along the border.
double crease_angle(const Surface& surface, const Border& border);

/// Returns for each border true if triangles with edges this long (`edge`: Å at a place) should end at it. This is so
/// if triangles that bridge the border would be farther from the surface than elsewhere, h sin(angle/2) / 4 against
/// h²/(6 r), and if the crease is not shorter than an edge.
std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge);

struct TriangleMesh;

/// The attributes of a vertex of a mesh on a surface, except for its position.
struct MeshVertex {
  glm::dvec3 normal{0.0};        ///< unit normal of the surface
  std::uint32_t face = kNone;    ///< face of the surface that the vertex lies on
  std::uint32_t crease = kNone;  ///< border that the vertex moves along, or kNone
  float size = 0.0f;             ///< wanted length (Å) of edges around the vertex
  float scale = 1.0f;            ///< factor of that length due to refinements
  float least_cosine = 0.0f;  ///< triangles with a smaller cosine between their normal and the vertex's are folded over
  bool pinned = false;        ///< true if the vertex stays: creases end or meet here, or it was put here for good
  bool frozen = false;        ///< true if the vertex, and edges between two such ones, stay except for mending
  bool active = true;         ///< true if passes change the neighbourhood of the vertex
  bool changed = true;        ///< true if changed since distances were last measured
  bool unchecked = true;      ///< true if changed since crossings were last searched for

  void note_change() { changed = unchecked = true; }

  /// True if the surface has no single normal here.
  bool on_crease() const { return crease != kNone || pinned; }
};

/// The amount by which the quality of a triangle falls if it is folded over.
inline constexpr double kFold = 2.0;

/// The number of folded triangles among several, and their worst quality.
class WorstQuality {
 public:
  void add(double quality) {
    if (quality < 0.0) ++folded_, quality += kFold;
    worst_ = std::min(worst_, quality);
  }
  /// Returns a number that is higher for better triangles; folds count before anything else.
  double score() const { return worst_ - folded_; }

 private:
  int folded_ = 0;
  double worst_ = 1.0;
};

/// The qualities of triangles (remesh_tuning.h), cached as long as nothing around them changes.
class TriangleQuality {
 public:
  /// All three arguments must outlive this object.
  TriangleQuality(const HalfEdges& links, const std::vector<glm::dvec3>& positions,
                  const std::vector<MeshVertex>& vertices)
      : links_(links), positions_(positions), vertices_(vertices) {
    extend();
  }

  /// Returns the quality of a triangle of these vertices, the first of them at x; less kFold if the triangle is folded
  /// over.
  double of(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const;
  /// Returns the quality of a triangle as it is.
  double of(std::uint32_t triangle) const;
  /// Returns the score of all triangles around a vertex, as it is or moved to x.
  double score_around(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  /// Computes and caches the qualities of all triangles.
  void compute_all();
  void remember(std::uint32_t triangle, double quality) { known_[triangle] = static_cast<float>(quality); }
  void forget(std::uint32_t triangle) { known_[triangle] = kUnknown, stale_[triangle] = 1; }
  void forget_all();
  /// Marks a triangle with edges that have to be checked for flips again.
  void mark_stale(std::uint32_t triangle) { stale_[triangle] = 1; }
  /// Returns the marks, true for each stale triangle, and clears them.
  std::vector<std::uint8_t> take_stale();
  /// Makes room for triangles that were added.
  void extend();
  /// Renumbers triangles; to be called before HalfEdges::compact().
  void compact();

 private:
  static constexpr float kUnknown = 9.0f;
  bool is_folded(std::uint32_t vertex, const glm::dvec3& normal, double size) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  const std::vector<MeshVertex>& vertices_;
  std::vector<float> known_;         ///< per triangle: its quality, or kUnknown
  std::vector<std::uint8_t> stale_;  ///< per triangle: 1 if its edges have to be checked for flips
};

/// The edge length (Å) wanted at a point of a face.
using EdgeLength = std::function<double(const SurfacePoint&)>;

/// A mesh on a surface. Changes keep vertex and triangle numbers, cached qualities and the guard in step. They are not
/// checked: callers decide which changes are valid.
class MeshOnSurface {
 public:
  /// `base` is closed, and its vertices lie on the surface; `vertex_face` has for each vertex a face that it lies on.
  /// `keep` is true for each border of the surface that edges follow; the walk is barred from crossing these. `surface`
  /// and `walk` must outlive the mesh.
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
  /// Returns the wanted length (Å) of an edge.
  double wanted(std::uint32_t half) const {
    return 0.5 * (vertices_[links_.from(half)].size + vertices_[links_.to(half)].size);
  }
  /// True if the component of the vertex has more vertices than it needs.
  bool can_spare(std::uint32_t vertex) const;
  PlacedTriangle placed(std::uint32_t triangle) const { return guard_.placed(triangle); }
  TriangleQuality& quality() { return quality_; }
  const TriangleQuality& quality() const { return quality_; }
  CrossingGuard& guard() { return guard_; }
  const CrossingGuard& guard() const { return guard_; }

  /// Moves a vertex and leaves the cached qualities of the triangles around it to the caller.
  void place(std::uint32_t vertex, const SurfacePoint& at);
  void move(std::uint32_t vertex, const SurfacePoint& at);
  void split(std::uint32_t half, const SurfacePoint& at);
  void poke(std::uint32_t triangle, const SurfacePoint& at);
  void collapse(std::uint32_t half);
  void flip(std::uint32_t half);
  /// Flips an edge if the qualities of both new triangles are known: that of the half-edge's triangle, and that of its
  /// twin's.
  void flip(std::uint32_t half, const std::array<double, 2>& qualities);
  /// Renumbers vertices and triangles so that those that were removed leave no gaps.
  void compact();

  /// If true, triangles may lean as far as RemeshTuning::least_cosine; otherwise as little as the wanted edges let
  /// them.
  void allow_lean(bool allowed);
  /// Multiplies the wanted length of edges around a vertex, and leaves cached qualities to the caller.
  void scale_size(std::uint32_t vertex, float factor);

 private:
  void update_vertex(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t crease);
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
