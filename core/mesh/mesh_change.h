// SPDX-License-Identifier: BSD-3-Clause
// A change of a few triangles that has not been made: what it would make and remove, and where its vertex would
// go.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

struct MeshChange {
  enum class Kind : std::uint8_t { flip, collapse, split, poke, move };
  Kind kind = Kind::flip;
  std::uint32_t where = kNone;  ///< a half-edge; of a poke the triangle, of a move the vertex
  SurfacePoint at;              ///< of a split, poke or move: where the vertex comes

  bool places_vertex() const { return kind == Kind::split || kind == Kind::poke || kind == Kind::move; }
};

/// The triangles that a change makes and those that it takes away. A new vertex has the number that it will have.
struct Exchange {
  std::vector<PlacedTriangle> made;
  std::vector<std::uint32_t> gone;
};
Exchange exchange_by(const MeshOnSurface& mesh, const MeshChange& change);

/// visit(PlacedTriangle) for those that a change makes.
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
      links.around(links.from(change.where), [&](std::uint32_t edge) {
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
      links.around(change.where, [&](std::uint32_t half) {
        PlacedTriangle moved = placed(change.where, links.to(half), links.opposite(half));
        moved.at[0] = change.at.position;
        visit(moved);
      });
  }
}

/// visit(triangle) for those that a change takes away.
template <typename Visit>
void for_each_gone(const MeshOnSurface& mesh, const MeshChange& change, const Visit& visit) {
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
      links.around(links.from(change.where), [&](std::uint32_t half) { visit(half / 3); });
      break;
    case MeshChange::Kind::move:
      links.around(change.where, [&](std::uint32_t half) { visit(half / 3); });
  }
}

/// May the first vertex of an edge go into the second? One of a crease goes along it only, one where creases end or
/// meet stays, and two creases must not fall together.
bool may_vanish(const MeshOnSurface& mesh, std::uint32_t half);

/// Would no triangle that a change makes pass through watched ones?
bool crosses_nothing(const MeshOnSurface& mesh, const MeshChange& change);

/// Makes a change. A vertex of a crease that goes into one beside it pins that one there.
void make(MeshOnSurface& mesh, const MeshChange& change);

/// Below the middle of an edge, of a crease on it; nothing where the surface is another sheet there.
std::optional<SurfacePoint> edge_middle(const MeshOnSurface& mesh, std::uint32_t half);

/// Of a vertex on a crease, the middle of its neighbours along it; nothing unless there are two.
std::optional<glm::dvec3> crease_middle(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Of the triangles around a vertex, the mean of their centroids by area: what Lloyd's algorithm moves to.
glm::dvec3 centroid_around(const MeshOnSurface& mesh, std::uint32_t vertex);

/// Where relaxation moves a vertex; nothing if it stays, as where its triangles would become poor.
std::optional<SurfacePoint> relaxed(const MeshOnSurface& mesh, std::uint32_t vertex);

}  // namespace meniscus
