// SPDX-License-Identifier: BSD-3-Clause
// Takes out what is a sphere, and doubles vertices where paint or normals differ.
#include "exporters/path_tracers/scene_items.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/image/color_space.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/shape_mesh.h"

namespace meniscus::path_tracers {
namespace {

/// Makes one SceneMesh of triangles whose corners may differ in colour and normal.
class MeshMaker {
 public:
  MeshMaker(float opacity, const glm::dvec3& origin) : origin_(origin) { mesh_.opacity = opacity; }

  /// vertex: of the mesh it comes from.
  std::uint32_t corner(std::uint32_t vertex, const glm::dvec3& position, const glm::dvec3& normal,
                       const glm::vec3& color) {
    const glm::vec3 written(normal);
    const auto [begin, end] = doubles_.equal_range(vertex);
    for (auto entry = begin; entry != end; ++entry)
      if (mesh_.normals[entry->second] == written && mesh_.colors[entry->second] == color) return entry->second;
    const auto made = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.emplace_back(position - origin_);
    mesh_.normals.push_back(written);
    mesh_.colors.push_back(color);
    doubles_.emplace(vertex, made);
    return made;
  }

  void add(const std::array<std::uint32_t, 3>& triangle) { mesh_.triangles.push_back(triangle); }
  SceneMesh take() { return std::move(mesh_); }

 private:
  SceneMesh mesh_;
  glm::dvec3 origin_;
  std::unordered_multimap<std::uint32_t, std::uint32_t> doubles_;
};

/// Per triangle: its sphere is one of the scene's.
std::vector<bool> whole_spheres(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                                std::vector<SceneSphere>& spheres) {
  const Surface& surface = object.surface;
  const Coloring& coloring = object.coloring;
  std::vector<bool> is_sphere(surface.faces.size(), false);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    if (face.kind != PatchKind::convex || face.loop_count != 0) continue;
    const std::uint32_t atom = surface.convex[face.patch].atom;
    if (coloring.by_volume(atom)) continue;
    is_sphere[f] = true;
  }
  std::vector<bool> drawn(surface.faces.size(), false), left_out(mesh.triangles.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t f = mesh.face[t];
    if (f == kNone || !is_sphere[f]) continue;
    left_out[t] = true;
    if (drawn[f]) continue;
    drawn[f] = true;
    const Ball& ball = surface.atoms[mesh.atom[t]];
    const Paint paint{linear_from_srgb(triangle_color(mesh, coloring, t)), coloring.opacity_of(mesh.atom[t])};
    spheres.push_back({ball.center - origin, ball.radius, paint});
  }
  return left_out;
}

std::unordered_map<std::uint32_t, glm::dvec3> normals_of_sharp_corners(const TriangleMesh& mesh) {
  std::unordered_map<std::uint32_t, glm::dvec3> normals;
  normals.reserve(mesh.sharp_corners.size());
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n)
    normals.emplace(mesh.sharp_corners[n], mesh.sharp_corner_normals[n]);
  return normals;
}

/// What tells how the triangles of a mesh look.
struct TrianglePaint {
  const TriangleMesh& mesh;
  const Coloring& coloring;
  std::size_t first_cap;           ///< this and all behind it are caps
  std::optional<glm::vec3> color;  ///< sRGB, of caps

  bool by_map(std::size_t t) const { return t < first_cap && coloring.by_volume(mesh.atom[t]); }
  /// Of those that no map colours.
  glm::vec3 operator()(std::size_t t) const {
    if (t < first_cap) return linear_from_srgb(triangle_color(mesh, coloring, t));
    return linear_from_srgb(color.value_or(coloring.atom[mesh.atom[t]]));
  }
};

/// One mesh an opacity.
std::vector<SceneMesh> meshes_of(const TrianglePaint& paint, const std::vector<bool>& left_out,
                                 const glm::dvec3& origin) {
  const TriangleMesh& mesh = paint.mesh;
  const auto sharp = normals_of_sharp_corners(mesh);
  std::vector<glm::vec3> at_vertices;
  if (paint.coloring.volume) at_vertices = vertex_colors(mesh, paint.coloring);
  std::map<float, MeshMaker, std::greater<>> makers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!left_out.empty() && left_out[t]) continue;
    const float opacity = paint.coloring.opacity_of(mesh.atom[t]);
    MeshMaker& maker = makers.try_emplace(opacity, opacity, origin).first->second;
    const bool by_map = paint.by_map(t);
    const glm::vec3 color = by_map ? glm::vec3(0.0f) : paint(t);
    std::array<std::uint32_t, 3> corners{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      const auto own = sharp.find(static_cast<std::uint32_t>(3 * t) + k);
      corners[k] = maker.corner(v, mesh.positions[v], own == sharp.end() ? mesh.normals[v] : own->second,
                                by_map ? linear_from_srgb(at_vertices[v]) : color);
    }
    maker.add(corners);
  }
  std::vector<SceneMesh> meshes;
  meshes.reserve(makers.size());
  for (auto& [opacity, maker] : makers) meshes.push_back(maker.take());
  return meshes;
}

}  // namespace

SceneItem surface_item(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                       const std::optional<CapRows>& caps) {
  SceneItem item;
  std::vector<bool> left_out;
  if (!caps) left_out = whole_spheres(object, mesh, origin, item.spheres);
  const std::size_t first_cap = mesh.triangles.size() - (caps ? caps->count : 0);
  item.meshes = meshes_of({mesh, object.coloring, first_cap, caps ? caps->color : std::nullopt}, left_out, origin);
  item.copies = object.copies;
  // x -> R x + t of the molecule's coordinates, of those that count from the origin.
  for (RigidMotion& copy : item.copies) copy.translation += copy.rotation * origin - origin;
  return item;
}

SceneItem shapes_item(std::span<const Atom> atoms, const ColoredShapes& shapes, const glm::dvec3& origin) {
  const Coloring& coloring = shapes.coloring;
  const auto paint = [&](std::uint32_t atom) {
    return Paint{linear_from_srgb(coloring.atom[atom]), coloring.opacity_of(atom)};
  };
  SceneItem item;
  item.is_surface = false;
  for (const SphereShape& sphere : shapes.shapes.spheres)
    if (coloring.shows(sphere.atom))
      item.spheres.push_back({sphere.center - origin, sphere.radius, paint(sphere.atom)});
  for (const CylinderShape& cylinder : shapes.shapes.cylinders) {
    const glm::dvec3 from = cylinder.from - origin, to = cylinder.to - origin, middle = 0.5 * (from + to);
    if (coloring.shows(cylinder.from_atom))
      item.cylinders.push_back({from, middle, cylinder.radius, paint(cylinder.from_atom)});
    if (coloring.shows(cylinder.to_atom))
      item.cylinders.push_back({middle, to, cylinder.radius, paint(cylinder.to_atom)});
  }
  if (shapes.shapes.mesh.triangles.empty()) return item;
  ColoredShapes rest;
  rest.shapes.mesh = shapes.shapes.mesh;
  rest.coloring = coloring;
  ShapeObject made = shape_object(atoms, rest, 1.0);  // no mesh is made, so that its tolerance does not matter
  const TriangleMesh mesh = shown_part(std::move(made.mesh), made.object.coloring);
  item.meshes = meshes_of({mesh, made.object.coloring, mesh.triangles.size(), {}}, {}, origin);
  return item;
}

}  // namespace meniscus::path_tracers
