// SPDX-License-Identifier: BSD-3-Clause
// Joins caps to what planes leave of a surface, as one mesh.
#include "exporters/blender/capped_mesh.h"

#include <utility>

#include "core/mesh/section_mesh.h"
#include "core/mesh/tessellate.h"

namespace meniscus::blender {
namespace {

/// The caps' positions as vertices of the mesh: those on rims are there already.
std::vector<std::uint32_t> add_vertices(TriangleMesh& mesh, const CapMesh& caps, std::span<const ClipPlane> planes) {
  std::vector<std::uint32_t> vertex = caps.rim;
  for (std::size_t t = 0; t < caps.triangles.size(); ++t)
    for (const std::uint32_t v : caps.triangles[t]) {
      if (vertex[v] != kNone) continue;
      vertex[v] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(caps.positions[v]);
      mesh.normals.push_back(planes[caps.plane[t]].normal);
    }
  return vertex;
}

}  // namespace

CappedMesh capped_mesh(const SurfaceObject& object, std::span<const ClipPlane> planes, bool one_color,
                       double tolerance) {
  if (planes.empty()) return {shown_part(tessellate(object.surface, {tolerance, true}), object.coloring), {}};
  const CapAtoms atoms(object.surface.atoms, object.surface.probe_radius, cap_parts(std::span(&object, 1), one_color));
  CutMesh cut = cut_mesh(tessellate(object.surface, {tolerance, true}), planes, atoms);
  TriangleMesh mesh = std::move(cut.surface);
  mesh.partly_hidden = false;  // caps close it
  const CapMesh& caps = cut.caps;
  const std::vector<std::uint32_t> vertex = add_vertices(mesh, caps, planes);
  CappedMesh result;
  for (std::size_t t = 0; t < caps.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      mesh.sharp_corners.push_back(static_cast<std::uint32_t>(3 * mesh.triangles.size()) +
                                   static_cast<std::uint32_t>(k));
      mesh.sharp_corner_normals.push_back(planes[caps.plane[t]].normal);
      const std::uint32_t a = caps.triangles[t][k], b = caps.triangles[t][(k + 1) % 3];
      if (caps.rim[a] != kNone && caps.rim[b] != kNone) mesh.sharp_edges.push_back({vertex[a], vertex[b]});
    }
    const auto& [a, b, c] = caps.triangles[t];
    mesh.triangles.push_back({vertex[a], vertex[b], vertex[c]});
    mesh.face.push_back(kNone);
    mesh.kind.push_back(PatchKind::convex);
    mesh.patch.push_back(kNone);
    mesh.component.push_back(0);
    mesh.atom.push_back(caps.atom[t]);
    if (object.coloring.shows(caps.atom[t])) result.cap_plane.push_back(caps.plane[t]);
  }
  result.mesh = shown_part(std::move(mesh), object.coloring);
  return result;
}

}  // namespace meniscus::blender
