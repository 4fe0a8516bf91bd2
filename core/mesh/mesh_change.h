// SPDX-License-Identifier: BSD-3-Clause
// Changes of a few triangles of a mesh on a surface, and passes of such changes that bring edges to the wanted lengths
// and make triangles even.
#pragma once

#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

/// A local change of a mesh that has not been made yet. The half-edge of a flip or split is the edge; a collapse merges
/// the first vertex of the half-edge into the second.
struct MeshChange {
  enum class Kind : std::uint8_t { flip, collapse, split, poke, move };
  Kind kind = Kind::flip;
  std::uint32_t where = kNone;  ///< a half-edge; for a poke the triangle, for a move the vertex
  SurfacePoint at;              ///< the place of the vertex that a split, poke or move inserts or moves

  bool places_vertex() const { return kind == Kind::split || kind == Kind::poke || kind == Kind::move; }
};

/// The triangles that a change makes, and the numbers of those that it removes. A made triangle has the numbers and
/// positions (Å) of its vertices, counter-clockwise seen from outside. A vertex that the change inserts has the number
/// links().vertex_count().
struct TriangleExchange {
  std::vector<PlacedTriangle> made;
  std::vector<std::uint32_t> removed;
};
TriangleExchange exchange_by(const MeshOnSurface& mesh, const MeshChange& change);

/// Calls visit(PlacedTriangle) for each triangle that a change makes.
template <typename Visit>
void for_each_made(const MeshOnSurface& mesh, const MeshChange& change, const Visit& visit) {
  const HalfEdges& links = mesh.links();
  const auto& x = mesh.positions();
  const auto placed = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return PlacedTriangle{{a, b, c}, {x[a], x[b], x[c]}};
  };
  const std::uint32_t m = links.vertex_count();
  switch (change.kind) {
    case MeshChange::Kind::flip: {
      const std::uint32_t a = links.from(change.where), b = links.to(change.where);
      const std::uint32_t c = links.opposite(change.where), d = links.opposite(links.twin(change.where));
      visit(placed(d, c, a));
      visit(placed(c, d, b));
      break;
    }
    case MeshChange::Kind::collapse: {
      const std::uint32_t b = links.to(change.where);
      links.for_each_leaving(links.from(change.where), [&](std::uint32_t edge) {
        const std::uint32_t c = links.to(edge), d = links.opposite(edge);
        if (c != b && d != b) visit(placed(b, c, d));
      });
      break;
    }
    case MeshChange::Kind::split:
      for (const std::uint32_t side : {change.where, links.twin(change.where)}) {
        const std::uint32_t from = links.from(side), to = links.to(side), c = links.opposite(side);
        visit(PlacedTriangle{{from, m, c}, {x[from], change.at.position, x[c]}});
        visit(PlacedTriangle{{m, to, c}, {change.at.position, x[to], x[c]}});
      }
      break;
    case MeshChange::Kind::poke:
      for (std::uint32_t half = 3 * change.where; half < 3 * change.where + 3; ++half) {
        const std::uint32_t a = links.from(half), b = links.to(half);
        visit(PlacedTriangle{{a, b, m}, {x[a], x[b], change.at.position}});
      }
      break;
    case MeshChange::Kind::move:
      links.for_each_leaving(change.where, [&](std::uint32_t half) {
        PlacedTriangle moved = placed(change.where, links.to(half), links.opposite(half));
        moved.at[0] = change.at.position;
        visit(moved);
      });
  }
}

/// Calls visit(triangle) for each triangle that a change removes.
template <typename Visit>
void for_each_removed(const MeshOnSurface& mesh, const MeshChange& change, const Visit& visit) {
  const HalfEdges& links = mesh.links();
  switch (change.kind) {
    case MeshChange::Kind::flip:
    case MeshChange::Kind::split:
      visit(change.where / 3);
      visit(links.twin(change.where) / 3);
      break;
    case MeshChange::Kind::poke:
      visit(change.where);
      break;
    case MeshChange::Kind::collapse:
      links.for_each_leaving(links.from(change.where), [&](std::uint32_t half) { visit(half / 3); });
      break;
    case MeshChange::Kind::move:
      links.for_each_leaving(change.where, [&](std::uint32_t half) { visit(half / 3); });
  }
}

/// True if the first vertex of an edge may be merged into the second. A vertex on a crease may only move along the
/// crease, a vertex where creases end or meet must stay, and two creases must not fall together.
bool is_mergeable(const MeshOnSurface& mesh, std::uint32_t half);

/// True if no triangle that a change makes would pass through a triangle at a guarded vertex. The mesh guards vertices
/// where triangles have crossed (CrossingGuard).
bool is_free_of_crossings(const MeshOnSurface& mesh, const MeshChange& change);

/// Makes a change without checking it: callers decide which changes are valid, for example by is_mergeable(). A
/// collapse pins the vertex that remains, so that it never moves, if the other one leaves its crease or was itself
/// pinned on one.
void apply_change(MeshOnSurface& mesh, const MeshChange& change);

/// Returns the point of the surface that is found by walking from an edge's ends to the midpoint; for a crease edge,
/// the nearest point of the crease. Returns nothing if that point is far from the midpoint, which then lies near
/// another sheet of the surface.
std::optional<SurfacePoint> edge_middle(const MeshOnSurface& mesh, std::uint32_t half);

/// Returns the midpoint of the two neighbours of a crease vertex along its crease; nothing unless there are two.
std::optional<glm::dvec3> crease_middle(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Returns the mean of the centroids of the triangles around a vertex, weighted by area (Lloyd's target).
glm::dvec3 centroid_around(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Returns the place to which one step of relaxation moves a vertex: part of the way to the centroid around it or, on a
/// crease, to the middle of its neighbours along the crease. Returns nothing if the vertex stays: it is pinned or
/// frozen, the step would be too short or too long, the surface has no point there, or its triangles would become poor.
std::optional<SurfacePoint> relaxed(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Remeshes by splits, collapses, flips and moves of vertices (Botsch & Kobbelt, "A remeshing approach to
/// multiresolution modeling", 2004, section 4). Around guarded vertices (CrossingGuard) no pass lets triangles pass
/// through others.
class Remesher {
 public:
  /// `mesh` must outlive the remesher.
  explicit Remesher(MeshOnSurface& mesh) : mesh_(mesh) {}

  /// Refines triangles coarser than wanted: splits and collapses edges until few are too long or too short.
  void approach();
  /// Splits long edges, collapses short ones, flips edges and relaxes vertices, `rounds` times.
  void even_out(int rounds);
  /// Shortens the wanted edges around these triangles by `factor`, and confines later passes to their neighbourhood.
  void refine(std::span<const std::uint32_t> triangles, double factor);

 private:
  /// True if passes may change the edge.
  bool is_changeable(std::uint32_t half) const;
  /// Splits the edges longer than `limit` times the wanted length; returns how many.
  std::uint32_t split_long(double limit);
  bool split(std::uint32_t half);
  /// Collapses the edges that are too short; returns how many.
  std::uint32_t collapse_short();
  bool try_collapse(std::uint32_t half);
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();

  MeshOnSurface& mesh_;
  bool approaching_ = false;
};

}  // namespace meniscus
