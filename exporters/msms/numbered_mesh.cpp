// SPDX-License-Identifier: BSD-3-Clause
// Picks the triangles of a component, numbers what they are made of, and welds what files could not tell apart.
#include "exporters/msms/numbered_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/index.h"
#include "core/math/ball_grid.h"
#include "exporters/msms/weld.h"

namespace meniscus {
namespace {

/// An equilateral triangle mesh of edge h has 2/(sqrt(3) h²) vertices per area; pieces of lattices between borders that
/// have vertices of their own have a fifth more.
const double kEdgeAtDensityOne = 1.1 * std::sqrt(2.0 / std::sqrt(3.0));

MsmsFaceKind kind_of(const Face& face) {
  switch (face.kind) {
    case PatchKind::convex:
      return MsmsFaceKind::contact;
    case PatchKind::toroidal:
      return MsmsFaceKind::toric;
    default:
      return MsmsFaceKind::reentrant;
  }
}

class Numbering {
 public:
  Numbering(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components,
            std::uint32_t component)
      : s_(surface), mesh_(mesh), components_(components), component_(component) {}

  MsmsMesh run() {
    number_faces();
    take_triangles();
    take_vertices();
    weld_short_edges(made_, kMsmsStep);
    name_faces();
    return std::move(made_);
  }

 private:
  bool is_ours(std::size_t face) const { return components_.of_face[face] == component_; }

  void number_faces() {
    number_.assign(s_.faces.size(), 0);
    std::uint32_t next = 0;
    for (const bool contact : {false, true})
      for (std::size_t f = 0; f < s_.faces.size(); ++f)
        if (is_ours(f) && (s_.faces[f].kind == PatchKind::convex) == contact) number_[f] = ++next;
  }

  void take_triangles() {
    std::size_t count = 0;
    for (const std::uint32_t face : mesh_.face) count += is_ours(face);
    made_.triangles.reserve(count);
    for (const bool contact : {false, true})
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::uint32_t f = mesh_.face[t];
        if (is_ours(f) && (mesh_.kind[t] == PatchKind::convex) == contact)
          made_.triangles.push_back({mesh_.triangles[t], kind_of(s_.faces[f]), number_[f]});
      }
    std::ranges::stable_sort(made_.triangles, {}, &MsmsTriangle::face);
  }

  void take_vertices() {
    find_faces_of_vertices();
    std::vector<std::uint32_t> place(mesh_.positions.size(), kNone);
    for (std::uint32_t v = 0; v < place.size(); ++v) {
      if (face_of_vertex_[v] == kNone) continue;
      place[v] = static_cast<std::uint32_t>(made_.vertices.size());
      made_.vertices.push_back(vertex(v));
    }
    for (MsmsTriangle& t : made_.triangles)
      for (std::uint32_t& corner : t.corner) corner = place[corner];
  }

  // Of each vertex of the component the first face that has it, and the closest atom: first of those that its faces
  // touch, for a vertex of a contact face lies on the face's own sphere, whatever rounding says of others.
  void find_faces_of_vertices() {
    face_of_vertex_.assign(mesh_.positions.size(), kNone);
    atom_of_vertex_.assign(mesh_.positions.size(), 0);
    std::vector<double> distance(mesh_.positions.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> touched;
    std::uint32_t known = kNone;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::uint32_t f = mesh_.face[t];
      if (!is_ours(f)) continue;
      if (f != known) list_touched(s_.faces[known = f], touched);
      for (const std::uint32_t v : mesh_.triangles[t]) {
        face_of_vertex_[v] = std::min(face_of_vertex_[v], f);
        for (const std::uint32_t atom : touched) {
          const double d = glm::distance(mesh_.positions[v], s_.atoms[atom].center) - s_.atoms[atom].radius;
          if (d >= distance[v] - kSame) continue;
          distance[v] = d;
          atom_of_vertex_[v] = atom;
        }
      }
    }
    look_farther(distance);
  }

  // Between two atoms, near a third one that only the next face touches, that one may be closest.
  void look_farther(std::vector<double>& distance) {
    double largest = 0;
    for (const Ball& atom : s_.atoms) largest = std::max(largest, atom.radius);
    const BallGrid grid(s_.atoms, largest + s_.probe_radius);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distance.size(), 256), [&](const auto& range) {
      for (std::size_t v = range.begin(); v != range.end(); ++v) {
        if (face_of_vertex_[v] == kNone || distance[v] < kOnSphere) continue;
        grid.for_each_near(mesh_.positions[v], distance[v] + largest, [&](std::uint32_t atom) {
          const double d = glm::distance(mesh_.positions[v], s_.atoms[atom].center) - s_.atoms[atom].radius;
          const bool closer = d < distance[v] - kSame || (d < distance[v] + kSame && atom < atom_of_vertex_[v]);
          if (!closer) return;
          distance[v] = std::min(d, distance[v]);
          atom_of_vertex_[v] = atom;
        });
      }
    });
  }

  void list_touched(const Face& face, std::vector<std::uint32_t>& touched) const {
    touched.clear();
    if (face.kind == PatchKind::convex) touched.push_back(s_.convex[face.patch].atom);
    if (face.kind == PatchKind::toroidal)
      touched.assign(s_.toroidal[face.patch].atom.begin(), s_.toroidal[face.patch].atom.end());
    if (face.kind == PatchKind::concave) {
      const ConcavePatch& patch = s_.concave[face.patch];
      const auto contacts = std::span(s_.contacts).subspan(patch.first_contact, patch.contact_count);
      touched.assign(contacts.begin(), contacts.end());
    }
  }

  MsmsVertex vertex(std::uint32_t v) const {
    MsmsVertex row{mesh_.positions[v], mesh_.normals[v], 0, atom_of_vertex_[v], 2};
    if (v < mesh_.corner_count) return row;
    const bool on_edge = v < mesh_.corner_count + mesh_.border_point_count;
    row.face = on_edge ? kOnEdge : kInside;
    if (on_edge) return row;
    const PatchKind kind = s_.faces[face_of_vertex_[v]].kind;
    row.level = kind == PatchKind::convex ? 1 : kind == PatchKind::concave ? 3 : 2;
    return row;
  }

  // By the triangles that are left: welding may have taken all of a face.
  void name_faces() {
    std::vector<bool> named(made_.vertices.size(), false);
    for (const MsmsTriangle& t : made_.triangles)
      for (const std::uint32_t v : t.corner) {
        if (named[v]) continue;
        named[v] = true;
        made_.vertices[v].face *= static_cast<std::int32_t>(t.face);
      }
  }

  static constexpr std::int32_t kOnEdge = -1, kInside = 1;  // times the number of the face
  static constexpr double kOnSphere = 1e-6;                 // Å: no other sphere can be closer
  static constexpr double kSame = 1e-9;  // Å: rounding does not decide between two atoms, their order does

  const Surface& s_;
  const TriangleMesh& mesh_;
  const ReducedComponents& components_;
  std::uint32_t component_;
  std::vector<std::uint32_t> number_;          // per face of the surface, from 1; 0: of another component
  std::vector<std::uint32_t> face_of_vertex_;  // kNone: of another component
  std::vector<std::uint32_t> atom_of_vertex_;
  MsmsMesh made_;
};

}  // namespace

double msms_edge(double density) { return kEdgeAtDensityOne / std::sqrt(density); }

MsmsMesh msms_mesh(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components,
                   std::uint32_t component) {
  return Numbering(surface, mesh, components, component).run();
}

}  // namespace meniscus
