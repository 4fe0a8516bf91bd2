// SPDX-License-Identifier: BSD-3-Clause
// Asks what a change of a few triangles would make of a mesh on a surface, and makes it.
#include "core/mesh/mesh_change.h"

#include "core/mesh/remesh_tuning.h"

namespace meniscus {

Exchange exchange_by(const MeshOnSurface& mesh, const MeshChange& change) {
  Exchange all;
  all.made.reserve(RemeshTuning::most_mended_edges);
  all.gone.reserve(RemeshTuning::most_mended_edges);
  for_each_made(mesh, change, [&](const PlacedTriangle& t) { all.made.push_back(t); });
  for_each_gone(mesh, change, [&](std::uint32_t t) { all.gone.push_back(t); });
  return all;
}

bool may_vanish(const MeshOnSurface& mesh, std::uint32_t half) {
  const HalfEdges& links = mesh.links();
  const MeshVertex& vertex = mesh.vertex(links.from(half));
  if (vertex.pinned) return false;
  if (vertex.crease != kNone && links.crease(half) != vertex.crease) return false;
  const auto joins_creases = [&](std::uint32_t side) {
    return links.crease(HalfEdges::next(side)) != kNone && links.crease(HalfEdges::last(side)) != kNone;
  };
  return !joins_creases(half) && !joins_creases(links.twin(half));
}

bool crosses_nothing(const MeshOnSurface& mesh, const MeshChange& change) {
  const Exchange all = exchange_by(mesh, change);
  return mesh.guard().crossings(all.made, all.gone) == 0;
}

std::ptrdiff_t fewer_crossings(const MeshOnSurface& mesh, const Exchange& exchange) {
  std::vector<PlacedTriangle> now;
  now.reserve(exchange.gone.size());
  for (const std::uint32_t t : exchange.gone) now.push_back(mesh.placed(t));
  return static_cast<std::ptrdiff_t>(mesh.guard().crossings(now, exchange.gone)) -
         static_cast<std::ptrdiff_t>(mesh.guard().crossings(exchange.made, exchange.gone));
}

void make(MeshOnSurface& mesh, const MeshChange& change) {
  switch (change.kind) {
    case MeshChange::Kind::flip:
      mesh.flip(change.where);
      break;
    case MeshChange::Kind::collapse: {
      const MeshVertex& from = mesh.vertex(mesh.links().from(change.where));
      if (from.on_crease() && (mesh.links().crease(change.where) == kNone || from.pinned))
        mesh.vertex(mesh.links().to(change.where)).pinned = true;
      mesh.collapse(change.where);
      break;
    }
    case MeshChange::Kind::split:
      mesh.split(change.where, change.at);
      break;
    case MeshChange::Kind::poke:
      mesh.poke(change.where, change.at);
      break;
    case MeshChange::Kind::move:
      mesh.move(change.where, change.at);
  }
}

}  // namespace meniscus
