// SPDX-License-Identifier: BSD-3-Clause
// Makes meshes of surfaces, shapes and pockets, and estimates how many triangles a surface gets.
#include "core/mesh/mesh_objects.h"

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/mesh/border_samples.h"
#include "core/mesh/even_mesh.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/tessellate.h"
#include "core/queries/copies.h"

namespace meniscus {

double tolerance_of(const MeshRequest& request, glm::ivec2 size, const Camera& camera, std::span<const Ball> balls) {
  if (request.tolerance_pixels == 0.0) return request.tolerance;
  // A pixel's height is measured on the plane at distance 1 (perspective), or is the same everywhere (Å, orthographic).
  double pixel = 2.0 * half_extent(camera, double(size.x) / size.y).y / size.y;
  if (camera.projection == Projection::perspective) {
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec3 forward = view_basis(camera).forward;
    for (const Ball& ball : balls) {
      nearest = std::min(nearest, glm::dot(ball.center - camera.position, forward) - ball.radius);
    }
    pixel *= std::max(nearest, 0.1);
  }
  return std::clamp(request.tolerance_pixels * pixel, kSmallestTolerance, kLargestTolerance);
}

std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance, bool may_be_empty) {
  std::vector<TriangleMesh> meshes;
  bool any = false;
  for (const SurfaceObject& object : objects) {
    meshes.push_back(shown_part(tessellate(object.surface, {tolerance, true}), object.coloring));
    any = any || !meshes.back().triangles.empty();
  }
  if (!any && !may_be_empty) throw RequestError("no part of the surface is shown, so there is no mesh to write");
  return meshes;
}

namespace {

/// The measured density of an even mesh by tolerance: vertices per Å² times tolerance times radius of curvature.
constexpr double kEvenVertices = 0.36;
/// The number of triangles per vertex of an even mesh.
constexpr double kTrianglesAVertex = 2.0;
/// The measured number of triangles per border segment, on both sides together, in a mesh that follows patches.
constexpr double kTrianglesASegment = 2.3;

double patch_aligned_triangles(const Surface& surface, double tolerance) {
  const EdgeRule rule(MeshOptions{tolerance, true});
  double triangles = 0.0;
  for (const Border& border : surface.borders)
    if (border.radius > 0.0)
      triangles += kTrianglesASegment * std::max(1.0, border.sweep * border.radius / rule.chord(border.radius));
  for (const Face& face : surface.faces) {
    const double edge = rule.edge(tube_radius(surface, face));
    triangles += 4.0 / std::numbers::sqrt3 * face.area / (edge * edge);
  }
  return triangles;
}

double even_triangles(const Surface& surface, const MeshFineness& fineness) {
  double vertices = fineness.density * surface.area;
  if (fineness.density == 0.0)
    for (const Face& face : surface.faces)
      vertices += kEvenVertices * face.area / (fineness.tolerance * std::max(tube_radius(surface, face), 0.1));
  return kTrianglesAVertex * vertices;
}

}  // namespace

MeshFineness fineness_of(const MeshRequest& request, bool even, double density, glm::ivec2 size, const Camera& camera,
                         std::span<const Ball> balls) {
  MeshFineness fineness{tolerance_of(request, size, camera, balls), {}, density, even};
  if (request.tolerance_pixels == 0.0 || camera.projection == Projection::orthographic) return fineness;
  const double wanted = request.tolerance_pixels * 2.0 * half_extent(camera, double(size.x) / size.y).y / size.y;
  fineness.tolerance_at = [wanted, position = camera.position, forward = view_basis(camera).forward,
                           smallest = fineness.tolerance](const glm::dvec3& x) {
    return std::clamp(wanted * glm::dot(x - position, forward), smallest, kLargestTolerance);
  };
  return fineness;
}

double estimated_triangles(const Surface& surface, const MeshFineness& fineness) {
  return fineness.even || fineness.density > 0.0 ? even_triangles(surface, fineness)
                                                 : patch_aligned_triangles(surface, fineness.tolerance);
}

FineMesh fine_mesh(const Surface& surface, const MeshFineness& fineness) {
  if (fineness.even || fineness.density > 0.0)
    return even_mesh(surface, {fineness.density, fineness.tolerance, fineness.tolerance_at});
  FineMesh made{tessellate(surface, {fineness.tolerance, true}), {}, {}};
  made.vertex_face = vertex_faces(made.mesh);
  made.vertex_atom = vertex_atoms(made.mesh);
  return made;
}

namespace {

/// Returns the number of parts that a circle is divided into. A facet between points that are `parts` times as far
/// apart as neighbours is then within the tolerance of its sphere (root 2) or cylinder (1).
int divisions(double radius, double tolerance, double parts) {
  const double angle = std::acos(std::max(0.0, 1.0 - tolerance / radius));
  return std::max(8, static_cast<int>(std::ceil(parts * std::numbers::pi / angle)));
}

/// Adds the triangles of shapes to a mesh.
class ShapeMesher {
 public:
  ShapeMesher(TriangleMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {}

  void add(const SphereShape& sphere) {
    const int columns = 2 * ((divisions(sphere.radius, tolerance_, std::numbers::sqrt2) + 1) / 2), rows = columns / 2;
    const auto point = [&](double latitude, double longitude) {
      const glm::dvec3 n(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                         std::sin(latitude));
      vertex(sphere.center + sphere.radius * n, n);
    };
    const std::uint32_t south = next();
    point(-0.5 * std::numbers::pi, 0.0);
    std::vector<std::uint32_t> rings;
    for (int row = 1; row < rows; ++row) {
      rings.push_back(next());
      for (int k = 0; k < columns; ++k)
        point(std::numbers::pi * (double(row) / rows - 0.5), 2.0 * std::numbers::pi * k / columns);
    }
    const std::uint32_t north = next();
    point(0.5 * std::numbers::pi, 0.0);
    const auto count = static_cast<std::uint32_t>(columns);
    fan(south, rings.front(), count, true, sphere.atom);
    for (std::size_t n = 0; n + 1 < rings.size(); ++n) band(rings[n], rings[n + 1], count, sphere.atom);
    fan(north, rings.back(), count, false, sphere.atom);
  }

  void add(const CylinderShape& cylinder) {
    const int count = divisions(cylinder.radius, tolerance_, 1.0);
    const glm::dvec3 axis = glm::normalize(cylinder.to - cylinder.from);
    const glm::dvec3 helper = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, helper)), v = glm::cross(axis, u);
    std::array<std::uint32_t, 3> rings{};
    for (int n = 0; n < 3; ++n) {
      rings[static_cast<std::size_t>(n)] = next();
      const glm::dvec3 center = cylinder.from + 0.5 * n * (cylinder.to - cylinder.from);
      for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        const glm::dvec3 normal = std::cos(angle) * u + std::sin(angle) * v;
        vertex(center + cylinder.radius * normal, normal);
      }
    }
    const auto points = static_cast<std::uint32_t>(count);
    band(rings[0], rings[1], points, cylinder.from_atom);
    band(rings[1], rings[2], points, cylinder.to_atom);
    const std::uint32_t first = next();
    vertex(cylinder.from, -axis);
    fan(first, rings[0], points, true, cylinder.from_atom);
    const std::uint32_t last = next();
    vertex(cylinder.to, axis);
    fan(last, rings[2], points, false, cylinder.to_atom);
  }

  void add(const MeshShape& shape) {
    const std::uint32_t first = next();
    for (std::size_t n = 0; n < shape.positions.size(); ++n) vertex(shape.positions[n], glm::dvec3(shape.normals[n]));
    for (const auto& [a, b, c] : shape.triangles) triangle(first + a, first + b, first + c, shape.atoms[a]);
  }

 private:
  std::uint32_t next() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }

  void vertex(const glm::dvec3& position, const glm::dvec3& normal) {
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t atom) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.atom.push_back(atom);
  }

  /// Adds the band between two rings, the second farther along the axis around which both go counter-clockwise.
  void band(std::uint32_t low, std::uint32_t high, std::uint32_t count, std::uint32_t atom) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t after = (k + 1) % count;
      triangle(low + k, low + after, high + after, atom);
      triangle(low + k, high + after, high + k, atom);
    }
  }

  /// Adds the fan between a tip and a ring, at the beginning or the end of the axis.
  void fan(std::uint32_t tip, std::uint32_t ring, std::uint32_t count, bool at_begin, std::uint32_t atom) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t here = ring + k, after = ring + (k + 1) % count;
      triangle(tip, at_begin ? after : here, at_begin ? here : after, atom);
    }
  }

  TriangleMesh& mesh_;
  double tolerance_;
};

/// Fills the columns of a mesh that have no meaning for shapes.
void fill_unused(TriangleMesh& mesh, double tolerance) {
  mesh.face.assign(mesh.triangles.size(), kNone);
  mesh.kind.assign(mesh.triangles.size(), PatchKind::convex);
  mesh.patch.assign(mesh.triangles.size(), kNone);
  mesh.component.assign(mesh.triangles.size(), 0);
  mesh.tolerance = tolerance;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

ShapeObject shape_object(std::span<const Atom> atoms, const ColoredShapes& shapes, double tolerance) {
  ShapeObject made;
  ShapeMesher mesher(made.mesh, tolerance);
  for (const SphereShape& sphere : shapes.shapes.spheres) mesher.add(sphere);
  for (const CylinderShape& cylinder : shapes.shapes.cylinders) mesher.add(cylinder);
  mesher.add(shapes.shapes.mesh);
  fill_unused(made.mesh, tolerance);

  SurfaceObject& object = made.object;
  object.name = "beside the surface";
  object.atom = made.mesh.atom;
  std::sort(object.atom.begin(), object.atom.end());
  object.atom.erase(std::unique(object.atom.begin(), object.atom.end()), object.atom.end());
  for (std::uint32_t& atom : made.mesh.atom)
    atom = static_cast<std::uint32_t>(std::lower_bound(object.atom.begin(), object.atom.end(), atom) -
                                      object.atom.begin());
  for (const std::uint32_t atom : object.atom) {
    object.surface.atoms.push_back({atoms[atom].position, atoms[atom].radius});
    object.coloring.atom.push_back(shapes.coloring.atom[atom]);
    if (!shapes.coloring.opacity.empty()) object.coloring.opacity.push_back(shapes.coloring.opacity[atom]);
  }
  const MeshSums sums = sums_of(made.mesh);
  object.surface.area = sums.area;
  object.surface.volume = sums.volume;
  object.surface.components = {{ComponentKind::outer, sums.area, sums.volume, 2}};
  return made;
}

ShapeObject joined(const SurfaceObject& object, TriangleMesh mesh, const ShapeObject& second) {
  ShapeObject whole{object, std::move(mesh)};
  SurfaceObject& both = whole.object;
  if (both.coloring.kind) {  // each atom becomes three, one per kind
    const auto count = static_cast<std::uint32_t>(both.atom.size());
    for (std::size_t t = 0; t < whole.mesh.triangles.size(); ++t)
      whole.mesh.atom[t] += count * static_cast<std::uint32_t>(whole.mesh.kind[t]);
    const std::vector<std::uint32_t> once = both.atom;
    const std::vector<Ball> balls = both.surface.atoms;
    both.coloring.atom.clear();
    for (std::size_t kind = 0; kind < 3; ++kind) {
      both.coloring.atom.insert(both.coloring.atom.end(), count, (*both.coloring.kind)[kind]);
      if (kind == 0) continue;
      append(both.atom, once);
      append(both.surface.atoms, balls);
    }
    both.coloring.kind.reset();
  }
  const auto first_vertex = static_cast<std::uint32_t>(whole.mesh.positions.size());
  const auto first_atom = static_cast<std::uint32_t>(both.atom.size());
  const auto component = static_cast<std::uint32_t>(both.surface.components.size());
  append(whole.mesh.positions, second.mesh.positions);
  append(whole.mesh.normals, second.mesh.normals);
  for (const auto& [a, b, c] : second.mesh.triangles)
    whole.mesh.triangles.push_back({first_vertex + a, first_vertex + b, first_vertex + c});
  append(whole.mesh.kind, second.mesh.kind);
  append(whole.mesh.face, second.mesh.face);
  append(whole.mesh.patch, second.mesh.patch);
  for (const std::uint32_t part : second.mesh.component) whole.mesh.component.push_back(component + part);
  for (const std::uint32_t atom : second.mesh.atom) whole.mesh.atom.push_back(first_atom + atom);
  append(both.atom, second.object.atom);
  append(both.surface.atoms, second.object.surface.atoms);
  append(both.surface.components, second.object.surface.components);
  append(both.coloring.atom, second.object.coloring.atom);
  both.coloring.hidden.clear();  // the mesh does not contain the hidden triangles
  return whole;
}

namespace {

/// Reverses the orientation of all triangles, and their normals.
void turn_over(TriangleMesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (glm::dvec3& normal : mesh.normals) normal = -normal;
  // Corners are numbered along their triangles and must stay in ascending order.
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n) {
    mesh.sharp_corner_normals[n] = -mesh.sharp_corner_normals[n];
    if (mesh.sharp_corners[n] % 3 == 0) continue;
    const bool both = mesh.sharp_corners[n] % 3 == 1 && n + 1 < mesh.sharp_corners.size() &&
                      mesh.sharp_corners[n + 1] == mesh.sharp_corners[n] + 1;
    if (both) {
      mesh.sharp_corner_normals[n + 1] = -mesh.sharp_corner_normals[n + 1];
      std::swap(mesh.sharp_corner_normals[n], mesh.sharp_corner_normals[n + 1]);
      ++n;
    } else {
      mesh.sharp_corners[n] += mesh.sharp_corners[n] % 3 == 1 ? 1 : -1;
    }
  }
}

}  // namespace

TriangleMesh pocket_mesh(const Pockets& pockets, double tolerance) {
  if (pockets.pockets.empty()) throw RequestError("there are no pockets, so there is no mesh to write");
  Surface all;
  std::vector<std::uint32_t> pocket_of_component;
  for (std::uint32_t n = 0; n < pockets.pockets.size(); ++n) {
    const Surface& surface = pockets.pockets[n].surface;
    append(all, surface);
    pocket_of_component.insert(pocket_of_component.end(), surface.components.size(), n);
  }
  TriangleMesh mesh = tessellate(all, {.tolerance = tolerance, .split_colors = false});
  for (std::uint32_t& component : mesh.component) component = pocket_of_component[component];
  turn_over(mesh);
  return mesh;
}

}  // namespace meniscus
