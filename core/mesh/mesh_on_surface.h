// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose vertices lie on an exact surface and may move along it, while it is remeshed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/mesh_crossings.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/surface_walk.h"
#include "core/mesh/triangle_quality.h"

namespace meniscus {

struct TriangleMesh;

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

  const Surface& surface_;
  const SurfaceWalk& walk_;
  EdgeLength edge_;
  bool may_lean_ = false;
  HalfEdges links_;
  std::vector<glm::dvec3> positions_;
  std::vector<MeshVertex> vertices_;
  TriangleQuality quality_{links_, positions_, vertices_};
  CrossingGuard guard_{links_, positions_};
};

}  // namespace meniscus
