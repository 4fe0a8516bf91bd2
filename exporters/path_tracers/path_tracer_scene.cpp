// SPDX-License-Identifier: BSD-3-Clause
// Makes the items of a scene from surfaces and shapes, places its lights, writes numbers as the shortest text that
// reads back the same, and writes the scene and its meshes, all or none.
#include "exporters/path_tracers/path_tracer_scene.h"

#include <tuple>
#include <unordered_map>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "core/math/box.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/mesh_objects.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus::path_tracers {
namespace {

/// Calls include(point, radius) for the balls that bound each copy of an item.
template <class Include>
void include_places(const SceneItem& item, const Include& include) {
  const auto include_copies = [&](const glm::dvec3& x, double radius) {
    for (const RigidMotion& copy : item.copies) include(copy(x), radius);
  };
  for (const SceneMesh& mesh : item.meshes)
    for (const glm::vec3& x : mesh.positions) include_copies(glm::dvec3(x), 0.0);
  for (const SceneSphere& sphere : item.spheres) include_copies(sphere.center, sphere.radius);
  for (const SceneCylinder& cylinder : item.cylinders)
    for (const glm::dvec3& end : {cylinder.from, cylinder.to}) include_copies(end, cylinder.radius);
}

}  // namespace

Extent extent_of(const PathTracerScene& scene) {
  Box box;
  for (const SceneItem& item : scene.items)
    include_places(item, [&](const glm::dvec3& x, double radius) {
      box.include(x - radius);
      box.include(x + radius);
    });
  return {0.5 * (box.low + box.high), 0.5 * glm::length(box.high - box.low)};
}

Lights lights_of(const PathTracerScene& scene) {
  const ViewBasis view = view_basis(scene.camera);
  const auto from = [&](double x, double y, double z) {
    return glm::normalize(x * view.right + y * view.up - z * view.forward);
  };
  Lights lights;
  if (scene.material != Material::glass) {
    lights.environment = {0.14f, 0.15f, 0.17f};
    lights.distant = {{-from(-0.45, 0.65, 0.75), {0.76f, 0.74f, 0.7f}},
                      {-from(0.85, -0.05, 0.45), {0.13f, 0.15f, 0.17f}},
                      {-from(0.0, 0.0, 1.0), {0.11f, 0.11f, 0.12f}}};
    return lights;
  }
  const Extent extent = extent_of(scene);
  const double away = 6.0 * extent.radius;
  lights.environment = glm::vec3(0.25f);
  const auto add = [&](const glm::dvec3& direction, double radius, float radiance) {
    lights.softboxes.push_back({extent.center + away * direction, -direction, radius, glm::vec3(radiance)});
  };
  add(from(-0.45, 0.75, 0.45), 2.5 * extent.radius, 4.0f);
  add(from(0.9, 0.1, 0.3), 1.5 * extent.radius, 2.0f);
  // The background softbox fills the picture, with a margin for rays that glass refracts.
  const double depth = glm::dot(extent.center - (scene.camera.position - scene.origin), view.forward) + away;
  const double seen = glm::length(half_extent(scene.camera, static_cast<double>(scene.width) / scene.height)) *
                      (scene.camera.projection == Projection::perspective ? depth : 1.0);
  add(view.forward, 1.2 * std::max(seen, 3.0 * extent.radius), 1.0f);
  return lights;
}

namespace {

template <class T>
std::string finite_text(T value) {
  if (!std::isfinite(value)) throw Error("export of a scene: a number of the surface is not finite");
  return fmt::format("{}", value == T(0) ? T(0) : value);  // no -0
}

template <class Vector>
std::string joined(const Vector& v, std::string_view between) {
  return fmt::format("{}{}{}{}{}", number_text(v.x), between, number_text(v.y), between, number_text(v.z));
}

/// Makes one SceneMesh of triangles whose corners may differ in colour and normal.
class MeshMaker {
 public:
  MeshMaker(float opacity, const glm::dvec3& origin) : origin_(origin) { mesh_.opacity = opacity; }

  /// Returns the number of the corner with this position, normal (rounded to single precision) and colour, and adds it
  /// if it is new. vertex: the number of the vertex in the original mesh.
  std::uint32_t corner(std::uint32_t vertex, const glm::dvec3& position, const glm::dvec3& normal,
                       const glm::vec3& color) {
    const glm::vec3 written(normal);
    const auto [begin, end] = duplicates_.equal_range(vertex);
    for (auto entry = begin; entry != end; ++entry)
      if (mesh_.normals[entry->second] == written && mesh_.colors[entry->second] == color) return entry->second;
    const auto made = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.emplace_back(position - origin_);
    mesh_.normals.push_back(written);
    mesh_.colors.push_back(color);
    duplicates_.emplace(vertex, made);
    return made;
  }

  void add(const std::array<std::uint32_t, 3>& triangle) { mesh_.triangles.push_back(triangle); }
  SceneMesh take() { return std::move(mesh_); }

 private:
  SceneMesh mesh_;
  glm::dvec3 origin_;
  std::unordered_multimap<std::uint32_t, std::uint32_t> duplicates_;
};

/// Adds the whole spheres of a surface to `spheres`. Returns true for each triangle of these spheres. Spheres that a
/// volume map colours are not among them.
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

/// Returns the normals of sharp corners by the number of the corner (3 times the triangle plus its place in it).
std::unordered_map<std::uint32_t, glm::dvec3> normals_of_sharp_corners(const TriangleMesh& mesh) {
  std::unordered_map<std::uint32_t, glm::dvec3> normals;
  normals.reserve(mesh.sharp_corners.size());
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n)
    normals.emplace(mesh.sharp_corners[n], mesh.sharp_corner_normals[n]);
  return normals;
}

/// The colours of the triangles of a mesh.
struct TrianglePaint {
  const TriangleMesh& mesh;
  const Coloring& coloring;
  std::size_t first_cap;           ///< this triangle and all later ones are caps
  std::optional<glm::vec3> color;  ///< colour of caps, sRGB; empty: the colours of atoms

  /// Returns true if a volume map colours triangle `t`.
  bool by_map(std::size_t t) const { return t < first_cap && coloring.by_volume(mesh.atom[t]); }
  /// Returns the colour of triangle `t` in linear light if no map colours it.
  glm::vec3 operator()(std::size_t t) const {
    if (t < first_cap) return linear_from_srgb(triangle_color(mesh, coloring, t));
    return linear_from_srgb(color.value_or(coloring.atom[mesh.atom[t]]));
  }
};

/// Returns one mesh for each opacity, by decreasing opacity. left_out: true for each triangle to skip; may be empty.
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

std::string number_text(double value) { return finite_text(value); }
std::string number_text(float value) { return finite_text(value); }
std::string vector_text(const glm::dvec3& v, std::string_view between) { return joined(v, between); }
std::string vector_text(const glm::vec3& v, std::string_view between) { return joined(v, between); }

SceneItem surface_item(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                       const std::optional<CapRows>& caps) {
  SceneItem item;
  std::vector<bool> left_out;
  if (!caps) left_out = whole_spheres(object, mesh, origin, item.spheres);
  const std::size_t first_cap = mesh.triangles.size() - (caps ? caps->count : 0);
  item.meshes = meshes_of({mesh, object.coloring, first_cap, caps ? caps->color : std::nullopt}, left_out, origin);
  item.copies = object.copies;
  // The motion x -> R x + t of the molecule's coordinates is expressed in coordinates relative to the origin.
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
  ShapeObject made = shape_object(atoms, rest, 1.0);  // only copies a mesh, so the tolerance has no effect
  const TriangleMesh mesh = shown_part(std::move(made.mesh), made.object.coloring);
  item.meshes = meshes_of({mesh, made.object.coloring, mesh.triangles.size(), {}}, {}, origin);
  return item;
}

namespace {

std::vector<SceneMesh> split(const std::vector<SceneMesh>& meshes) {
  std::vector<SceneMesh> parts;
  for (const SceneMesh& mesh : meshes)
    for (SceneMesh& part : split_colors(mesh)) parts.push_back(std::move(part));
  return parts;
}

/// Writes a mesh as PLY (G. Turk 1994): positions, normals, and perhaps colours r, g, b for Mitsuba's "vertex_color".
void write_mesh(OutputFile& file, const SceneMesh& mesh, bool with_colors) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  if (with_colors)
    for (const char* name : {"r", "g", "b"}) header += fmt::format("property float {}\n", name);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  BinaryRows rows;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    rows.put(mesh.positions[v]);
    rows.put(mesh.normals[v]);
    if (with_colors) rows.put(mesh.colors[v]);
  }
  for (const auto& triangle : mesh.triangles) {
    rows.put(std::uint8_t{3});
    rows.put(triangle);
  }
  file.write(header);
  file.write(rows.bytes());
}

}  // namespace

SceneReport write_scene(const PathTracerScene& given, const SceneTarget& target) {
  PathTracerScene scene = given;
  std::erase_if(scene.items, [](const SceneItem& item) { return item.empty(); });
  if (scene.items.empty()) throw RequestError("no part of the surface is shown, so there is no scene to write");
  OutputFolder output(target.folder, target.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(target.folder / (target.name + ending));
    return output.file(target.name + ending);
  };
  const bool has_colors = target.renderer == Renderer::mitsuba;  // colours of vertices
  std::size_t meshes = 0;
  for (SceneItem& item : scene.items) {
    if (!has_colors) item.meshes = split(item.meshes);
    for (SceneMesh& mesh : item.meshes) {
      for (glm::vec3& color : mesh.colors) color = written_color(scene.material, item.is_surface, color);
      write_mesh(begin_file(fmt::format("_{}.ply", ++meshes)), mesh, has_colors);
      report.triangles += mesh.triangles.size();
    }
    report.spheres += item.spheres.size();
    report.cylinders += item.cylinders.size();
  }
  if (target.renderer == Renderer::mitsuba)
    begin_file(".xml").write(mitsuba_text(scene, target.name));
  else
    begin_file(".pbrt").write(pbrt_text(scene, target.name));
  output.commit();
  return report;
}

namespace {

using Bytes = std::tuple<int, int, int>;

Bytes bytes_of(const glm::vec3& linear) {
  const glm::vec3 color = 255.0f * srgb_from_linear(linear);
  return {static_cast<int>(std::lround(color.x)), static_cast<int>(std::lround(color.y)),
          static_cast<int>(std::lround(color.z))};
}

glm::vec3 color_of(const Bytes& bytes) {
  const auto [red, green, blue] = bytes;
  return linear_from_srgb(glm::vec3(red, green, blue) / 255.0f);
}

}  // namespace

std::vector<SceneMesh> split_colors(const SceneMesh& mesh) {
  std::vector<SceneMesh> parts;
  std::map<Bytes, std::uint32_t> part_of_color;
  std::vector<std::uint32_t> part, place;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Bytes bytes = bytes_of(mesh.colors[v]);
    const auto next = static_cast<std::uint32_t>(parts.size());
    const auto [found, is_new] = part_of_color.try_emplace(bytes, next);
    if (is_new) parts.emplace_back().opacity = mesh.opacity;
    SceneMesh& to = parts[found->second];
    part.push_back(found->second);
    place.push_back(static_cast<std::uint32_t>(to.positions.size()));
    to.positions.push_back(mesh.positions[v]);
    to.normals.push_back(mesh.normals[v]);
    to.colors.push_back(color_of(bytes));
  }
  for (const auto& [a, b, c] : mesh.triangles) parts[part[a]].triangles.push_back({place[a], place[b], place[c]});
  return parts;
}

}  // namespace meniscus::path_tracers
