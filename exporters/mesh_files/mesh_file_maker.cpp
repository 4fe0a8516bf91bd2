// SPDX-License-Identifier: BSD-3-Clause
// Finds points inside components, and makes objects of mesh files from surfaces with colours, and from pockets.
//
// The winding number of the triangles confirms a point; otherwise a point below one of them is taken.
#include "exporters/mesh_files/mesh_formats.h"

#include "core/base/error.h"
#include "core/base/version.h"
#include "core/color/named_colors.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/velocity.h"
#include "core/queries/copies.h"

namespace meniscus {
namespace {

constexpr std::size_t kPlaces = 48;  // vertices tried per component; the longest step is taken
constexpr double kLongest = 2.8, kShorter = 0.7, kShortest = 1e-4, kEnough = 1.0;  // Å, except the ratio kShorter
constexpr double kShareOfHeight = 0.1, kSmallestShare = 1e-5;  // depths below a triangle, as shares of its height
constexpr double kSame = 1e-9;                                 // rounding error of distances, Å

/// Returns the longest tried step (Å, at most kLongest) from a point of the surface along its normal whose end is as
/// far from the surface as the step is long. A ball with this radius around the end is empty and touches the surface at
/// the point. side: 1 to step along the normal, -1 against it. Returns 0 if no step works.
double clear_step(const SurfaceDistance& distance, const glm::dvec3& from, const glm::dvec3& normal, double side) {
  for (double step = kLongest; step > kShortest; step *= kShorter)
    if (std::abs(distance(from + side * step * normal).distance - side * step) < kSame) return step;
  return 0.0;
}

/// Returns the winding number of closed triangles around a point. It is the sum of their solid angles (A. van Oosterom
/// and J. Strackee, IEEE Trans. Biomed. Eng. 30, 125 (1983), equation 8) divided by 4 pi, rounded to an integer.
long winding_number(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const glm::dvec3& point) {
  double angle = 0.0;
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i] - point, b = mesh.positions[j] - point, c = mesh.positions[k] - point;
    const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  }
  return std::lround(angle / (4.0 * std::numbers::pi));
}

/// Returns a point right below a triangle that has this winding number, or nothing. The mesh alone determines it,
/// because coarse triangles may exclude points inside the exact surface.
std::optional<glm::dvec3> point_below(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                                      long winding) {
  for (const std::uint32_t t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    for (double share = kShareOfHeight; share > kSmallestShare; share *= 0.1) {
      // Triangles face the solvent, which is inside a cavity and outside a solid.
      const glm::dvec3 point = (a + b + c) / 3.0 - static_cast<double>(winding) * share / longest * cross;
      if (winding_number(mesh, triangles, point) == winding) return point;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<glm::dvec3> inner_points(const Surface& surface, const TriangleMesh& mesh) {
  const SurfaceDistance distance(surface);
  std::vector<std::vector<std::uint32_t>> triangles(surface.components.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[mesh.component[t]].push_back(t);
  std::vector<glm::dvec3> points;
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    const double side = surface.components[c].kind == ComponentKind::cavity ? 1.0 : -1.0;
    const std::size_t stride = std::max<std::size_t>(1, triangles[c].size() / kPlaces);
    double longest = 0.0;
    glm::dvec3 point(0.0);
    for (std::size_t n = 0; n < triangles[c].size() && longest < kEnough; n += stride) {
      const std::uint32_t v = mesh.triangles[triangles[c][n]][0];
      const double step = clear_step(distance, mesh.positions[v], mesh.normals[v], side);
      if (step <= longest) continue;
      longest = step;
      point = mesh.positions[v] + side * step * mesh.normals[v];
    }
    const long winding = side > 0.0 ? -1 : 1;
    if (longest == 0.0 || winding_number(mesh, triangles[c], point) != winding) {
      const auto below = point_below(mesh, triangles[c], winding);
      if (!below) throw OpenSurfaceError("no point was found inside component {} of the mesh; ask for a finer one", c);
      point = *below;
    }
    points.push_back(point);
  }
  return points;
}

namespace {

std::array<std::uint8_t, 3> bytes_of(const glm::vec3& color) {
  const auto byte = [](float channel) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f)));
  };
  return {byte(color.x), byte(color.y), byte(color.z)};
}

/// Moves the rows of vertices to their places, and removes those whose place is kNone. count: number of places.
template <class T>
void move_rows(std::vector<T>& rows, const std::vector<std::uint32_t>& place, std::size_t count) {
  std::vector<T> moved(count);
  for (std::size_t v = place.size(); v-- > 0;)  // backwards, so that the first of merged vertices determines the row
    if (place[v] != kNone) moved[place[v]] = std::move(rows[v]);
  rows = std::move(moved);
}

void move_vertices(FineMesh& mesh, const std::vector<std::uint32_t>& place) {
  move_rows(mesh.vertex_face, place, mesh.mesh.positions.size());
  move_rows(mesh.vertex_atom, place, mesh.mesh.positions.size());
}

FileAtom file_atom(const Atom& atom) {
  return {atom.name, atom.residue_name, atom.chain, atom.residue_number, atom.insertion_code, atom.position};
}

SurfaceView view_of(const SurfaceObject& object) { return {object.name, object.surface, object.coloring, object.atom}; }

}  // namespace

std::string about_line(std::string_view surface, double scale, const MeshFineness& fineness) {
  const std::string how = fineness.density > 0.0 ? fmt::format("{:g} vertices per square Angstrom", fineness.density)
                                                 : fmt::format("tolerance {:.4g} Angstrom", fineness.tolerance);
  return fmt::format("Meniscus {}: 1 Angstrom is {:g}; {} surface, {}", MENISCUS_VERSION, scale, surface, how);
}

MeshFileMaker::MeshFileMaker(FileRequest request, std::string about) : request_(std::move(request)) {
  file_.scale = request_.scale;
  file_.material = request_.material;
  file_.about = std::move(about);
  for (const Atom& atom : request_.atoms) file_.atoms.push_back(file_atom(atom));
}

// Returns true if all places of an object can share one mesh. Values of a volume map, the open sky, and tolerances in
// pixels of a camera differ from place to place.
bool MeshFileMaker::can_share_mesh(const SurfaceObject& object) const {
  return request_.places && !object.coloring.volume && !request_.fineness.tolerance_at &&
         std::ranges::none_of(request_.numbers,
                              [](const std::string& name) { return name == "open_sky" || name == "atom_open_sky"; });
}

void MeshFileMaker::add(SurfaceObject given) {
  if (can_share_mesh(given)) {
    const std::size_t before = file_.objects.size();
    add(view_of(given), fine_mesh(given.surface, request_.fineness));
    if (file_.objects.size() == before) return;
    further_places_ += given.copies.size() - 1;
    for (RigidMotion& place : given.copies) place.translation *= request_.scale;
    file_.objects.back().places = std::move(given.copies);
    return;
  }
  if (given.copies.size() > 1) request_.velocities = {};
  std::vector<SurfaceObject> one;
  one.push_back(std::move(given));
  const SurfaceObject object = merged(std::move(one));
  add(view_of(object), fine_mesh(object.surface, request_.fineness));
}

void MeshFileMaker::add(const SurfaceView& object, FineMesh mesh) {
  std::vector<glm::dvec3> velocities;
  if (!request_.velocities.empty()) {
    std::vector<glm::dvec3> atoms;
    for (const std::uint32_t atom : object.atom) atoms.push_back(request_.velocities[atom]);
    velocities = vertex_velocities(object.surface, mesh.mesh, atoms);
  }
  const Welding welding = weld(mesh.mesh, kFileStep, request_.scale);
  joined_ += welding.joined;
  fins_ += welding.fins;
  flipped_ += welding.flipped;
  flat_ += welding.flat;
  move_vertices(mesh, welding.into);
  if (!velocities.empty()) move_rows(velocities, welding.into, mesh.mesh.positions.size());
  if (request_.inner_points) {
    const std::vector<glm::dvec3> points = inner_points(object.surface, mesh.mesh);
    for (std::uint32_t c = 0; c < points.size(); ++c)
      (object.surface.components[c].kind == ComponentKind::cavity ? file_.cavities : file_.solids)
          .push_back({request_.scale * points[c], components_ + c});
  }
  add_meshed(object, std::move(mesh), std::move(velocities));
}

void MeshFileMaker::add(ShapeObject shapes) {
  FineMesh mesh{std::move(shapes.mesh), {}, {}};
  mesh.vertex_face.assign(mesh.mesh.positions.size(), kNone);
  mesh.vertex_atom = vertex_atoms(mesh.mesh);
  std::vector<glm::dvec3> velocities;
  if (!request_.velocities.empty())
    for (const std::uint32_t atom : mesh.vertex_atom)
      velocities.push_back(request_.velocities[shapes.object.atom[atom]]);
  add_meshed(view_of(shapes.object), std::move(mesh), std::move(velocities));
}

void MeshFileMaker::add_meshed(const SurfaceView& object, FineMesh mesh, std::vector<glm::dvec3> velocities) {
  FileObject made;
  made.name = object.name.empty() ? "surface" : object.name;
  made.numbers = vertex_numbers(request_.numbers, {object, mesh, request_.atoms, request_.buried, components_});
  if (object.coloring.hides_some()) {
    std::vector<bool> shown;
    for (const std::uint32_t a : mesh.mesh.atom) shown.push_back(object.coloring.shows(a));
    const std::vector<std::uint32_t> place = keep_triangles(mesh.mesh, shown);
    move_vertices(mesh, place);
    for (VertexNumbers& column : made.numbers) move_rows(column.values, place, mesh.mesh.positions.size());
    if (!velocities.empty()) move_rows(velocities, place, mesh.mesh.positions.size());
  }
  for (const glm::dvec3& x : mesh.mesh.positions) made.positions.emplace_back(request_.scale * x);
  for (const glm::dvec3& n : mesh.mesh.normals) made.normals.emplace_back(n);
  for (const glm::dvec3& v : velocities) made.velocities.emplace_back(request_.scale * v);
  for (const glm::vec3& color : vertex_colors(mesh.mesh, object.coloring)) made.colors.push_back(bytes_of(color));
  if (object.coloring.is_translucent())
    for (const std::uint32_t a : mesh.vertex_atom) made.opacities.push_back(object.coloring.opacity_of(a));
  if (!object.coloring.volume)
    for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t)
      made.triangle_colors.push_back(bytes_of(triangle_color(mesh.mesh, object.coloring, t)));
  for (std::size_t v = 0; v < made.positions.size(); ++v) {
    const std::uint32_t face = mesh.vertex_face[v];
    made.kind.push_back(face == kNone ? PatchKind::convex : object.surface.faces[face].kind);
    made.atom.push_back(object.atom[mesh.vertex_atom[v]]);
  }
  for (const std::uint32_t c : mesh.mesh.component) made.component.push_back(components_ + c);
  made.triangles = std::move(mesh.mesh.triangles);
  made.is_cavity = std::ranges::all_of(object.surface.components,
                                       [](const Component& c) { return c.kind == ComponentKind::cavity; });
  components_ += static_cast<std::uint32_t>(object.surface.components.size());
  triangles_ += made.triangles.size();
  if (!made.triangles.empty()) file_.objects.push_back(std::move(made));
}

MeshFile MeshFileMaker::take() {
  if (file_.objects.empty()) throw RequestError("no part of the surface is shown, so there is no mesh to write");
  return std::move(file_);
}

MeshFile pocket_file(const TriangleMesh& mesh) {
  MeshFile file;
  file.about =
      fmt::format("Meniscus " MENISCUS_VERSION ": pockets, tolerance {} Angstrom, in Angstrom", mesh.tolerance);
  std::vector<std::uint32_t> vertex(mesh.positions.size(), kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t pocket = mesh.component[t];
    while (file.objects.size() <= pocket) {
      const std::size_t rank = file.objects.size() + 1;
      file.objects.emplace_back();
      file.objects.back().name = fmt::format("pocket {}", rank);
      file.objects.back().numbers = {{"pocket", {}}};
    }
    FileObject& object = file.objects[pocket];
    std::array<std::uint32_t, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      if (vertex[v] == kNone) {
        vertex[v] = static_cast<std::uint32_t>(object.positions.size());
        object.positions.emplace_back(mesh.positions[v]);
        object.normals.emplace_back(mesh.normals[v]);
        object.colors.push_back(bytes_of(categorical_color(pocket)));
        object.numbers.front().values.push_back(static_cast<float>(pocket + 1));
        object.atom.push_back(kNone);
        object.kind.push_back(mesh.kind[t]);
      }
      triangle[k] = vertex[v];
    }
    object.triangles.push_back(triangle);
    object.triangle_colors.push_back(bytes_of(categorical_color(pocket)));
    object.component.push_back(pocket);
  }
  return file;
}

}  // namespace meniscus
