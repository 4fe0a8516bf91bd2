// SPDX-License-Identifier: BSD-3-Clause
// Cuts a closed mesh by one plane after another, divides what is left into surface and caps, and joins both again.
#include "core/mesh/section_mesh.h"

#include <tuple>

#include "core/mesh/tessellate.h"
#include "core/queries/copies.h"

namespace meniscus {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Returns the barycentric coordinates of a point in a triangle.
glm::dvec3 shares_in(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::dot(normal, normal);
  if (!(area > 0.0)) return glm::dvec3(1.0 / 3.0);
  const double of_b = glm::dot(glm::cross(x - a, c - a), normal) / area;
  const double of_c = glm::dot(glm::cross(b - a, x - a), normal) / area;
  return {1.0 - of_b - of_c, of_b, of_c};
}

/// Copies the parts of a cut mesh into tables of their own.
class Sorter {
 public:
  Sorter(const TriangleMesh& mesh, const Solid& solid) : mesh_(mesh), solid_(solid) {}

  CutMesh run() {
    result_.surface.tolerance = mesh_.tolerance;
    result_.surface.partly_hidden = true;
    surface_vertex_.assign(solid_.positions.size(), kNone);
    cap_vertex_.assign(solid_.positions.size(), kNone);
    for (std::size_t n = 0; n < mesh_.sharp_corners.size(); ++n)
      sharp_[mesh_.sharp_corners[n]] = mesh_.sharp_corner_normals[n];
    for (const SolidPiece& piece : solid_.pieces)
      if (piece.source != kNone) add_surface(piece);
    for (const SolidPiece& piece : solid_.pieces)
      if (piece.source == kNone) add_cap(piece);
    for (const auto& [a, b] : solid_.sharp_edges)
      if (surface_vertex_[a] != kNone && surface_vertex_[b] != kNone)
        result_.surface.sharp_edges.push_back({surface_vertex_[a], surface_vertex_[b]});
    return std::move(result_);
  }

 private:
  void add_surface(const SolidPiece& piece) {
    TriangleMesh& to = result_.surface;
    add_sharp_corners(piece);
    Corners corner{};
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& v = surface_vertex_[piece.corner[k]];
      if (v == kNone) {
        v = static_cast<std::uint32_t>(to.positions.size());
        to.positions.push_back(solid_.positions[piece.corner[k]]);
        to.normals.push_back(solid_.normals[piece.corner[k]]);
      }
      corner[k] = v;
    }
    to.triangles.push_back(corner);
    to.face.push_back(mesh_.face[piece.source]);
    to.kind.push_back(mesh_.kind[piece.source]);
    to.patch.push_back(mesh_.patch[piece.source]);
    to.component.push_back(mesh_.component[piece.source]);
    to.atom.push_back(mesh_.atom[piece.source]);
  }

  /// Adds the normals of a triangle at a cusp, which are interpolated between the normals of its own corners.
  void add_sharp_corners(const SolidPiece& piece) {
    TriangleMesh& to = result_.surface;
    const auto first = sharp_.lower_bound(3 * piece.source);
    if (first == sharp_.end() || first->first > 3 * piece.source + 2) return;
    const Corners& source = mesh_.triangles[piece.source];
    std::array<glm::dvec3, 3> normal;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto at = sharp_.find(3 * piece.source + k);
      normal[k] = at == sharp_.end() ? mesh_.normals[source[k]] : at->second;
    }
    const std::vector<glm::dvec3>& x = mesh_.positions;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto same = std::ranges::find(source, piece.corner[k]);
      if (same != source.end() &&
          !sharp_.contains(static_cast<std::uint32_t>(3 * piece.source + (same - source.begin()))))
        continue;
      const glm::dvec3 share = shares_in(solid_.positions[piece.corner[k]], x[source[0]], x[source[1]], x[source[2]]);
      to.sharp_corners.push_back(static_cast<std::uint32_t>(3 * to.triangles.size() + k));
      to.sharp_corner_normals.push_back(
          glm::normalize(share.x * normal[0] + share.y * normal[1] + share.z * normal[2]));
    }
  }

  void add_cap(const SolidPiece& piece) {
    CapMesh& to = result_.caps;
    Corners corner{};
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& v = cap_vertex_[piece.corner[k]];
      if (v == kNone) {
        v = static_cast<std::uint32_t>(to.positions.size());
        to.positions.push_back(solid_.positions[piece.corner[k]]);
        to.rim.push_back(surface_vertex_[piece.corner[k]]);
      }
      corner[k] = v;
    }
    to.triangles.push_back(corner);
    to.plane.push_back(piece.plane);
    to.atom.push_back(piece.atom);
  }

  const TriangleMesh& mesh_;
  const Solid& solid_;
  CutMesh result_;
  std::vector<std::uint32_t> surface_vertex_, cap_vertex_;
  std::map<std::uint32_t, glm::dvec3> sharp_;
};

TriangleMesh moved(TriangleMesh mesh, const RigidMotion& motion) {
  for (glm::dvec3& position : mesh.positions) position = motion(position);
  for (std::vector<glm::dvec3>* normals : {&mesh.normals, &mesh.sharp_corner_normals})
    for (glm::dvec3& normal : *normals) normal = motion.rotation * normal;
  return mesh;
}

void append(CapMesh& whole, const CapMesh& part) {
  const auto first = static_cast<std::uint32_t>(whole.positions.size());
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  for (const Corners& t : part.triangles) whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  whole.plane.insert(whole.plane.end(), part.plane.begin(), part.plane.end());
  whole.atom.insert(whole.atom.end(), part.atom.begin(), part.atom.end());
}

/// Returns true for each atom of placed_balls(objects) that is shown.
std::vector<bool> shown_atoms(std::span<const SurfaceObject> objects) {
  std::vector<bool> shown;
  for (const SurfaceObject& object : objects)
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy)
      for (std::uint32_t a = 0; a < object.surface.atoms.size(); ++a) shown.push_back(object.coloring.shows(a));
  return shown;
}

void drop_hidden(CapMesh& caps, const std::vector<bool>& shown) {
  CapMesh kept;
  kept.positions = std::move(caps.positions);
  for (std::size_t n = 0; n < caps.triangles.size(); ++n) {
    if (!shown[caps.atom[n]]) continue;
    kept.triangles.push_back(caps.triangles[n]);
    kept.plane.push_back(caps.plane[n]);
    kept.atom.push_back(caps.atom[n]);
  }
  caps = std::move(kept);
}

/// Returns the part of each atom of placed_balls(objects): atoms of one colour, opacity and visibility are a part. With
/// `one_color`, only opacity and visibility count.
std::vector<std::uint32_t> cap_parts(std::span<const SurfaceObject> objects, bool one_color) {
  std::map<std::tuple<float, float, float, float>, std::uint32_t> known;
  std::vector<std::uint32_t> parts;
  for (const SurfaceObject& object : objects)
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy)
      for (std::uint32_t a = 0; a < object.surface.atoms.size(); ++a) {
        const Coloring& coloring = object.coloring;
        const bool colored = !one_color && coloring.shows(a);
        const glm::vec3 color = colored ? coloring.atom[a] : glm::vec3(0.0f);
        const float opacity = coloring.shows(a) ? coloring.opacity_of(a) : 0.0f;
        parts.push_back(
            known.try_emplace({color.x, color.y, color.z, opacity}, static_cast<std::uint32_t>(known.size()))
                .first->second);
      }
  return parts;
}

}  // namespace

CutMesh cut_mesh(TriangleMesh mesh, std::span<const ClipPlane> planes, const CapAtoms& atoms) {
  if (planes.empty()) return {std::move(mesh), {}};
  const double border_length = std::sqrt(8.0 * mesh.tolerance);
  Solid solid{mesh.positions, mesh.normals, {}, mesh.sharp_edges};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    solid.pieces.push_back({mesh.triangles[t], t, kNone, kNone});
  for (std::uint32_t n = 0; n < planes.size(); ++n) solid = cut_solid(solid, planes[n], n, atoms, border_length);
  return Sorter(mesh, solid).run();
}

CapMesh section_caps(std::span<const SurfaceObject> objects, std::span<const ClipPlane> planes, bool one_color,
                     double tolerance) {
  CapMesh caps;
  if (objects.empty() || planes.empty()) return caps;
  const CapAtoms atoms(placed_balls(objects), objects[0].surface.probe_radius, cap_parts(objects, one_color));
  for (const SurfaceObject& object : objects) {
    const TriangleMesh mesh = tessellate(object.surface, {tolerance, false});
    for (const RigidMotion& copy : object.copies) append(caps, cut_mesh(moved(mesh, copy), planes, atoms).caps);
  }
  drop_hidden(caps, shown_atoms(objects));
  return caps;
}

namespace {

/// Adds the positions of caps as vertices of the mesh, which has those on rims already; returns their vertices.
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

}  // namespace meniscus
