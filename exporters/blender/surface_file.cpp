// SPDX-License-Identifier: BSD-3-Clause
// Turns the tables of surfaces and their meshes into the arrays of a .mns file.
#include "exporters/blender/surface_file.h"

#include <array>
#include <cassert>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "exporters/blender/shot.h"
#include "exporters/blender/mns_file.h"
#include "core/color/color_key_json.h"
#include "exporters/mesh/mesh_colors.h"

namespace meniscus::blender {
namespace {

using nlohmann::json;

json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Collects one column per field while walking a table.
template <class T>
class Column {
 public:
  void push(T value) { values_.push_back(value); }
  void push(const glm::dvec3& v) { values_.insert(values_.end(), {T(v.x), T(v.y), T(v.z)}); }
  std::span<const T> values() const { return values_; }

 private:
  std::vector<T> values_;
};
using Doubles = Column<double>;
using Floats = Column<float>;
using Indices = Column<std::uint32_t>;

/// Rows of vectors in single precision, each less `origin`.
void stream_vectors(MnsWriter& file, const std::string& name, const std::vector<glm::dvec3>& vectors,
                    const glm::dvec3& origin = glm::dvec3(0.0)) {
  file.add_streamed<float>(name, vectors.size(), 3, [&vectors, origin](ArraySink& out) {
    for (const glm::dvec3& vector : vectors) {
      const glm::dvec3 v = vector - origin;
      for (int axis = 0; axis < 3; ++axis) out.push(static_cast<float>(v[axis]));
    }
  });
}

template <std::size_t columns>
void stream_rows(MnsWriter& file, const std::string& name,
                 const std::vector<std::array<std::uint32_t, columns>>& rows) {
  file.add_streamed<std::uint32_t>(name, rows.size(), columns, [&rows](ArraySink& out) {
    for (const auto& row : rows)
      for (const std::uint32_t index : row) out.push(index);
  });
}

void stream_column(MnsWriter& file, const std::string& name, const std::vector<std::uint32_t>& column) {
  file.add_streamed<std::uint32_t>(name, column.size(), 1, [&column](ArraySink& out) {
    for (const std::uint32_t value : column) out.push(value);
  });
}

/// The mesh, which is larger than all the rest, is turned into arrays while they are written.
void add_mesh(MnsWriter& file, const TriangleMesh& mesh, const glm::dvec3& origin) {
  stream_vectors(file, "mesh.position", mesh.positions, origin);
  stream_vectors(file, "mesh.normal", mesh.normals);
  stream_rows(file, "mesh.triangle", mesh.triangles);
  file.add_streamed<std::uint8_t>("mesh.kind", mesh.kind.size(), 1, [&mesh](ArraySink& out) {
    for (const PatchKind kind : mesh.kind) out.push(static_cast<std::uint8_t>(kind));
  });
  stream_column(file, "mesh.patch", mesh.patch);
  stream_column(file, "mesh.component", mesh.component);
  stream_column(file, "mesh.atom", mesh.atom);
  stream_column(file, "mesh.sharp_corner", mesh.sharp_corners);
  stream_vectors(file, "mesh.sharp_corner_normal", mesh.sharp_corner_normals);
  stream_rows(file, "mesh.sharp_edge", mesh.sharp_edges);
}

void add_velocities(MnsWriter& file, const std::vector<glm::dvec3>& velocities) {
  if (!velocities.empty()) stream_vectors(file, "mesh.velocity", velocities);
}

void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms) {
  Doubles center, radius;
  Floats color;
  for (const Ball& ball : object.surface.atoms) {
    center.push(ball.center);
    radius.push(ball.radius);
  }
  for (const glm::vec3& c : object.coloring.atom) color.push(glm::dvec3(c));
  file.add("atom.center", center.values(), 3);
  file.add("atom.radius", radius.values());
  file.add("atom.color", color.values(), 3);
  file.add("atom.index", std::span(object.atom));
  if (!atoms.b_factor.empty()) file.add("atom.b_factor", std::span(atoms.b_factor));
  if (!atoms.atomic_number.empty()) file.add("atom.atomic_number", std::span(atoms.atomic_number));
  if (!atoms.residue_number.empty()) file.add("atom.res_id", std::span(atoms.residue_number));
  if (!atoms.chain.empty()) file.add("atom.chain_id", std::span(atoms.chain));
}

void add_convex(MnsWriter& file, const Surface& surface) {
  Indices atom, plane_range;
  for (const ConvexPatch& patch : surface.convex) {
    atom.push(patch.atom);
    plane_range.push(patch.first_plane);
    plane_range.push(patch.plane_count);
  }
  file.add("convex.atom", atom.values());
  file.add("convex.planes", plane_range.values(), 2);
}

void add_toroidal(MnsWriter& file, const Surface& surface) {
  Indices atom, probe, pieces;
  Doubles center, axis, start, circle;
  for (const ToroidalPatch& patch : surface.toroidal) {
    for (const bool has_piece : patch.has_piece) pieces.push(has_piece ? 1 : 0);
    for (const std::uint32_t a : patch.atom) atom.push(a);
    for (const std::uint32_t p : patch.probe) probe.push(p);
    center.push(patch.center);
    axis.push(patch.axis);
    start.push(patch.start);
    circle.push(patch.radius);
    circle.push(patch.sweep);
  }
  file.add("toroidal.atoms", atom.values(), 2);
  file.add("toroidal.probes", probe.values(), 2);
  file.add("toroidal.pieces", pieces.values(), 2);
  file.add("toroidal.center", center.values(), 3);
  file.add("toroidal.axis", axis.values(), 3);
  file.add("toroidal.start", start.values(), 3);
  file.add("toroidal.radius_sweep", circle.values(), 2);
}

void add_concave(MnsWriter& file, const Surface& surface) {
  Doubles center;
  Indices contacts, planes, cuts;
  for (const ConcavePatch& patch : surface.concave) {
    center.push(patch.center);
    contacts.push(patch.first_contact);
    contacts.push(patch.contact_count);
    planes.push(patch.first_plane);
    planes.push(patch.side_count);
    planes.push(patch.cut_count + patch.parting_count);
    cuts.push(patch.first_cut);
    cuts.push(patch.cut_count);
  }
  file.add("concave.center", center.values(), 3);
  file.add("concave.contacts", contacts.values(), 2);
  file.add("concave.planes", planes.values(), 3);
  file.add("concave.cuts", cuts.values(), 2);
  file.add("contact.atom", std::span(surface.contacts));
  file.add("cut.probe", std::span(surface.cuts));
  Doubles plane;
  for (const Plane& p : surface.planes) {
    plane.push(p.normal);
    plane.push(p.offset);
  }
  file.add("plane", plane.values(), 4);
}

json component_list(const Surface& surface, const TriangleMesh& mesh) {
  json list = json::array();
  const std::vector<MeshSums> sums = component_sums(mesh, surface.components.size());
  for (std::uint32_t c = 0; c < surface.components.size(); ++c) {
    const Component& component = surface.components[c];
    const MeshSums& m = sums[c];
    list.push_back({{"kind", component.kind == ComponentKind::outer ? "outer" : "cavity"},
                    {"area", component.area},
                    {"volume", component.volume},
                    {"euler", component.euler},
                    {"mesh_area", m.area},
                    {"mesh_volume", m.volume},
                    {"triangles", m.triangle_count}});
  }
  return list;
}

/// The matrix [rotation | translation], row after row.
json matrix(const RigidMotion& motion) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(motion.rotation[column][row]);
    rows.push_back(motion.translation[row]);
  }
  return rows;
}

json object_header(const MeshedObject& meshed, const std::string& prefix, const glm::dvec3& origin) {
  const Surface& surface = meshed.object.surface;
  const TriangleMesh& mesh = meshed.mesh;
  const MeshSums m = sums_of(mesh);
  json header{{"name", escaped(meshed.object.name)},
              {"prefix", prefix},
              {"copies", json::array()},
              {"probe_radius", surface.probe_radius},
              {"area", surface.area},
              {"volume", surface.volume},
              {"mesh",
               {{"origin", numbers(origin)},
                {"tolerance", mesh.tolerance},
                {"vertices", mesh.positions.size()},
                {"triangles", mesh.triangles.size()},
                {"closed", !mesh.partly_hidden},
                {"area", m.area},
                {"volume", m.volume}}},
              {"components", component_list(surface, mesh)},
              {"chain_names", meshed.atoms.chain_names}};
  for (const RigidMotion& copy : meshed.object.copies) header["copies"].push_back(matrix(copy));
  if (const auto& kinds = meshed.object.coloring.kind) {
    json colors = json::array();
    for (const glm::vec3& c : *kinds) colors.push_back(numbers(glm::dvec3(c)));
    header["kind_colors"] = colors;
  }
  return header;
}

}  // namespace

void write_objects(const std::string& path, Existing existing, std::span<const MeshedObject> objects,
                   const std::optional<Shot>& shot, const Provenance& provenance,
                   const std::optional<PlaceInRun>& place) {
  MnsWriter file;
  json list = json::array();
  for (const MeshedObject& meshed : objects) {
    if (meshed.mesh.triangles.empty()) continue;
    const std::string prefix = std::to_string(list.size()) + "/";
    const glm::dvec3 origin = mesh_origin(meshed.mesh);
    file.set_prefix(prefix);
    add_mesh(file, meshed.mesh, origin);
    add_velocities(file, meshed.velocities);
    add_atoms(file, meshed.object, meshed.atoms);
    add_convex(file, meshed.object.surface);
    add_toroidal(file, meshed.object.surface);
    add_concave(file, meshed.object.surface);
    list.push_back(object_header(meshed, prefix, origin));
  }
  assert(!list.empty());
  json header{{"format", "meniscus surface"},
              {"generator", "meniscus " MENISCUS_VERSION},
              {"source", {{"file", provenance.source}, {"radii_set", provenance.radii_set}}},
              {"device", provenance.device},
              {"unit", "angstrom"},
              {"objects", std::move(list)}};
  if (provenance.colors) header["colors"] = color_key_json(*provenance.colors);
  if (shot) header["camera"] = shot_object(*shot);
  if (place) header["sequence"] = {{"run", place->run}, {"frame", place->frame}, {"scene_frame", place->scene_frame}};
  file.write(path, existing, std::move(header));
}

}  // namespace meniscus::blender
