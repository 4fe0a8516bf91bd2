// SPDX-License-Identifier: BSD-3-Clause
// Measures surfaces at vertices, patches and atoms, and turns their tables and meshes into the arrays of a .mns file.
#include "exporters/blender/surface_file.h"

#include <cassert>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/color/color_key.h"
#include "core/color/color_key_json.h"
#include "core/color/color_maps.h"
#include "core/mesh/mesh_colors.h"
#include "core/queries/surface_parts.h"
#include "core/surface/measure.h"
#include "exporters/blender/mns_file.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus::blender {
namespace {

/// Returns the text with kUsualSurfaceNumbers in place of each word "usual".
std::string with_usual(std::string_view text) {
  std::string expanded;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t past = std::min(text.find(',', first), text.size());
    const std::string_view word = text.substr(first, past - first);
    expanded.append(first == 0 ? "" : ",").append(word == "usual" ? kUsualSurfaceNumbers : word);
    first = past + 1;
  }
  return expanded;
}

/// Returns the curvature at each vertex, and 0 for a vertex that lies on no patch.
std::vector<Curvature> exact_curvatures(const Surface& surface, const MeshedObject& object) {
  const TriangleMesh& mesh = object.mesh;
  const std::vector<std::uint32_t> face = object.vertex_face.empty() ? vertex_faces(mesh) : object.vertex_face;
  std::vector<Curvature> curvatures(mesh.positions.size());
  for (std::size_t v = 0; v < face.size(); ++v)
    if (face[v] != kNone) curvatures[v] = curvature(surface, face[v], mesh.positions[v]);
  return curvatures;
}

std::vector<float> floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// Adds requested columns of curvatures to an object.
class CurvatureAdder {
 public:
  CurvatureAdder(MeshedObject& object, const SurfaceNumbers& requested) : object_(object), requested_(requested) {}

  /// Adds mean and Gaussian curvature if they are requested. make() returns a Curvature per vertex; it is called only
  /// if at least one of the two is requested.
  template <class Make>
  void add_curvatures(const std::string& prefix, const Make& make) {
    const bool mean = is_requested(prefix + "mean_curvature"), gaussian = is_requested(prefix + "gaussian_curvature");
    if (!mean && !gaussian) return;
    const std::vector<Curvature> curvatures = make();
    if (mean) add_column(prefix + "mean_curvature", curvatures, &Curvature::mean);
    if (gaussian) add_column(prefix + "gaussian_curvature", curvatures, &Curvature::gaussian);
  }

  bool is_requested(std::string_view name) const {
    return std::ranges::find(requested_.names, name) != requested_.names.end();
  }

 private:
  void add_column(const std::string& name, const std::vector<Curvature>& curvatures, double Curvature::*which) {
    VertexNumbers column{name, {}};
    column.values.reserve(curvatures.size());
    for (const Curvature& c : curvatures) column.values.push_back(static_cast<float>(c.*which));
    object_.numbers.push_back(std::move(column));
  }

  MeshedObject& object_;
  const SurfaceNumbers& requested_;
};

/// Adds smoothed curvatures if they are requested. Returns a sentence if they are left out, or an empty text. Throws
/// RequestError instead if the user named them.
std::string add_smoothed(MeshedObject& object, CurvatureAdder& adder, bool by_name) {
  if (!object.mesh.partly_hidden && object.cap_plane.empty()) {
    adder.add_curvatures("smooth_", [&] { return smoothed_curvatures(object.mesh); });
    return {};
  }
  if (!adder.is_requested("smooth_mean_curvature") && !adder.is_requested("smooth_gaussian_curvature")) return {};
  const std::string reason = "curvature is averaged over a whole surface, of which --show or --clip leaves a part";
  if (by_name) throw RequestError(reason + "; leave smooth_mean_curvature and smooth_gaussian_curvature out");
  return reason + ": no smooth curvature is written";
}

std::string add_areas_of_atoms(MeshedObject& object, const CurvatureAdder& adder, bool by_name) {
  if (!adder.is_requested("atom_area") && !adder.is_requested("accessible_area")) return {};
  try {
    const AtomAreas areas = atom_areas(object.object.surface);
    if (adder.is_requested("atom_area")) object.atoms.area = floats(areas.surface);
    if (adder.is_requested("accessible_area")) object.atoms.accessible_area = floats(areas.accessible);
  } catch (const OpenSurfaceError& error) {
    if (by_name) throw;
    return fmt::format("areas of atoms are left out: {}", error.what());
  }
  return {};
}

void add_areas_of_patches(MeshedObject& object) {
  for (const std::uint32_t face : object.mesh.face)
    object.patch_area.push_back(face == kNone ? 0.0f : static_cast<float>(object.object.surface.faces[face].area));
}

void add_buried_areas(MeshedObject& object, std::span<const double> buried) {
  for (const std::uint32_t atom : object.object.atom)
    object.atoms.buried_area.push_back(atom < buried.size() ? static_cast<float>(buried[atom]) : 0.0f);
}

}  // namespace

SurfaceNumbers parse_surface_numbers(std::string_view text) {
  return {parse_vertex_numbers(with_usual(text)), text != "usual" && text != "all"};
}

std::string add_surface_numbers(MeshedObject& object, const SurfaceNumbers& requested, std::span<const double> buried) {
  const Surface& surface = object.object.surface;
  if (surface.faces.empty()) return {};
  CurvatureAdder adder(object, requested);
  adder.add_curvatures("", [&] { return exact_curvatures(surface, object); });
  const std::string without_smoothed = add_smoothed(object, adder, requested.by_name);
  const std::string without_areas = add_areas_of_atoms(object, adder, requested.by_name);
  if (adder.is_requested("open_sky")) object.numbers.push_back({"open_sky", vertex_open_sky(surface, object.mesh)});
  if (adder.is_requested("patch_area")) add_areas_of_patches(object);
  if (adder.is_requested("buried_area") && !buried.empty()) add_buried_areas(object, buried);
  return without_smoothed.empty() || without_areas.empty() ? without_smoothed + without_areas
                                                           : without_smoothed + "; " + without_areas;
}

namespace {

/// Returns the device without the number of threads, on which results do not depend.
std::string device_without_threads(const std::string& device) { return device.starts_with("cpu (") ? "cpu" : device; }

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
using Floats = Column<float>;

/// Adds an array of vectors relative to `origin` in single precision.
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
  file.add_streamed<std::uint32_t>(name, rows.size(), columns,
                                   [&rows](ArraySink& out) { out.push_all(std::as_bytes(std::span(rows))); });
}

void stream_column(MnsWriter& file, const std::string& name, const std::vector<std::uint32_t>& column) {
  file.add_streamed<std::uint32_t>(name, column.size(), 1,
                                   [&column](ArraySink& out) { out.push_all(std::as_bytes(std::span(column))); });
}

/// The value of mesh.kind for caps, as in the AOVs of pictures.
constexpr std::uint8_t kCap = 4;

/// Adds the arrays of a mesh. They are computed while they are written, because a mesh is larger than everything else.
/// first_cap: the number of the first triangle of caps.
void add_mesh(MnsWriter& file, const TriangleMesh& mesh, std::size_t first_cap, const glm::dvec3& origin) {
  stream_vectors(file, "mesh.position", mesh.positions, origin);
  stream_vectors(file, "mesh.normal", mesh.normals);
  stream_rows(file, "mesh.triangle", mesh.triangles);
  file.add_streamed<std::uint8_t>("mesh.kind", mesh.kind.size(), 1, [&mesh, first_cap](ArraySink& out) {
    for (std::size_t t = 0; t < mesh.kind.size(); ++t)
      out.push(t < first_cap ? static_cast<std::uint8_t>(mesh.kind[t]) : kCap);
  });
  stream_column(file, "mesh.patch", mesh.patch);
  stream_column(file, "mesh.component", mesh.component);
  stream_column(file, "mesh.atom", mesh.atom);
  stream_column(file, "mesh.sharp_corner", mesh.sharp_corners);
  stream_vectors(file, "mesh.sharp_corner_normal", mesh.sharp_corner_normals);
  stream_rows(file, "mesh.sharp_edge", mesh.sharp_edges);
}

void add_caps(MnsWriter& file, const MeshedObject& meshed) {
  const std::size_t first_cap = meshed.mesh.triangles.size() - meshed.cap_plane.size();
  file.add_streamed<std::uint32_t>("mesh.cap_plane", meshed.mesh.triangles.size(), 1,
                                   [&meshed, first_cap](ArraySink& out) {
                                     for (std::size_t t = 0; t < first_cap; ++t) out.push(kNone);
                                     for (const std::uint32_t plane : meshed.cap_plane) out.push(plane);
                                   });
}

/// Adds the values and colours of a volume map at vertices. Missing values are 0, and mesh.map_known marks them.
void add_map(MnsWriter& file, const TriangleMesh& mesh, const Coloring& coloring) {
  if (!coloring.volume) return;
  std::vector<float> values = vertex_map_values(mesh, *coloring.volume);
  std::vector<std::uint8_t> known;
  Floats colors;
  for (float& value : values) {
    colors.push(glm::dvec3(coloring.volume->scale.color(value)));
    known.push_back(!std::isnan(value));
    if (!known.back()) value = 0.0f;
  }
  file.add("mesh.map_value", std::span<const float>(values));
  file.add("mesh.map_color", colors.values(), 3);
  if (std::ranges::find(known, 0) != known.end()) file.add("mesh.map_known", std::span<const std::uint8_t>(known));
  if (coloring.own_color.empty()) return;
  std::vector<std::uint8_t> own(coloring.own_color.begin(), coloring.own_color.end());
  file.add("atom.own_color", std::span<const std::uint8_t>(own));
}

/// Adds the numbers of vertices and the areas of the patches of triangles.
void add_numbers(MnsWriter& file, const MeshedObject& meshed) {
  for (const VertexNumbers& column : meshed.numbers) file.add("mesh." + column.name, std::span(column.values));
  if (!meshed.patch_area.empty()) file.add("mesh.patch_area", std::span(meshed.patch_area));
}

void add_velocities(MnsWriter& file, const std::vector<glm::dvec3>& velocities) {
  if (!velocities.empty()) stream_vectors(file, "mesh.velocity", velocities);
}

/// Adds an array with `columns` values for each row of a table. push(sink, row) pushes the values of a row.
template <class T, class Row, class Push>
void stream_fields(MnsWriter& file, const std::string& name, const std::vector<Row>& table, int columns,
                   const Push& push) {
  file.add_streamed<T>(name, table.size(), columns, [&table, push](ArraySink& out) {
    for (const Row& row : table) push(out, row);
  });
}

void push(ArraySink& out, const glm::dvec3& v) {
  for (int axis = 0; axis < 3; ++axis) out.push(v[axis]);
}

void add_convex(MnsWriter& file, const Surface& surface) {
  using Out = ArraySink;
  using Patch = ConvexPatch;
  stream_fields<std::uint32_t>(file, "convex.atom", surface.convex, 1,
                               [](Out& out, const Patch& p) { out.push(p.atom); });
  stream_fields<std::uint32_t>(file, "convex.planes", surface.convex, 2, [](Out& out, const Patch& p) {
    out.push(p.first_plane);
    out.push(std::uint32_t{p.plane_count});
  });
}

void add_toroidal(MnsWriter& file, const Surface& surface) {
  using Out = ArraySink;
  using Patch = ToroidalPatch;
  const std::vector<Patch>& table = surface.toroidal;
  stream_fields<std::uint32_t>(file, "toroidal.atoms", table, 2, [](Out& out, const Patch& p) {
    for (const std::uint32_t a : p.atom) out.push(a);
  });
  stream_fields<std::uint32_t>(file, "toroidal.probes", table, 2, [](Out& out, const Patch& p) {
    for (const std::uint32_t probe : p.probe) out.push(probe);
  });
  stream_fields<std::uint32_t>(file, "toroidal.pieces", table, 2, [](Out& out, const Patch& p) {
    for (const bool has_piece : p.has_piece) out.push(std::uint32_t{has_piece});
  });
  stream_fields<double>(file, "toroidal.center", table, 3, [](Out& out, const Patch& p) { push(out, p.center); });
  stream_fields<double>(file, "toroidal.axis", table, 3, [](Out& out, const Patch& p) { push(out, p.axis); });
  stream_fields<double>(file, "toroidal.start", table, 3, [](Out& out, const Patch& p) { push(out, p.start); });
  stream_fields<double>(file, "toroidal.radius_sweep", table, 2, [](Out& out, const Patch& p) {
    out.push(double{p.radius});
    out.push(double{p.sweep});
  });
}

void add_concave(MnsWriter& file, const Surface& surface) {
  using Out = ArraySink;
  using Patch = ConcavePatch;
  const std::vector<Patch>& table = surface.concave;
  stream_fields<double>(file, "concave.center", table, 3, [](Out& out, const Patch& p) { push(out, p.center); });
  stream_fields<std::uint32_t>(file, "concave.contacts", table, 2, [](Out& out, const Patch& p) {
    out.push(p.first_contact);
    out.push(std::uint32_t{p.contact_count});
  });
  stream_fields<std::uint32_t>(file, "concave.planes", table, 3, [](Out& out, const Patch& p) {
    out.push(p.first_plane);
    out.push(std::uint32_t{p.side_count});
    out.push(static_cast<std::uint32_t>(p.cut_count + p.parting_count));
  });
  stream_fields<std::uint32_t>(file, "concave.cuts", table, 2, [](Out& out, const Patch& p) {
    out.push(p.first_cut);
    out.push(std::uint32_t{p.cut_count});
  });
  stream_column(file, "contact.atom", surface.contacts);
  stream_column(file, "cut.probe", surface.cuts);
  stream_fields<double>(file, "plane", surface.planes, 4, [](Out& out, const Plane& plane) {
    push(out, plane.normal);
    out.push(plane.offset);
  });
}

/// Returns the sums of each component without caps, which belong to no component.
std::vector<MeshSums> component_sums_of(const MeshedObject& meshed, std::size_t component_count) {
  if (meshed.cap_plane.empty()) return component_sums(meshed.mesh, component_count);
  TriangleMesh mesh;
  mesh.positions = meshed.mesh.positions;
  mesh.triangles = meshed.mesh.triangles;
  mesh.triangles.resize(mesh.triangles.size() - meshed.cap_plane.size());
  mesh.component = meshed.mesh.component;
  return component_sums(mesh, component_count);
}

json component_list(const MeshedObject& meshed) {
  const Surface& surface = meshed.object.surface;
  json list = json::array();
  const std::vector<MeshSums> sums = component_sums_of(meshed, surface.components.size());
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

/// Returns the matrix [rotation | translation] in row-major order.
json matrix(const RigidMotion& motion) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(motion.rotation[column][row]);
    rows.push_back(motion.translation[row]);
  }
  return rows;
}

json caps_header(const CutFile& cut) {
  json caps{{"planes", json::array()}};
  for (const ClipPlane& plane : cut.planes)
    caps["planes"].push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
  if (cut.style.color) caps["color"] = numbers(glm::dvec3(*cut.style.color));
  if (cut.style.hatching > 0.0) {
    caps["hatching"] = {{"distance", cut.style.hatching}, {"share", kHatchedShare}, {"light", kHatchedLight}};
    for (const ClipPlane& plane : cut.planes)
      caps["hatching"]["across"].push_back(numbers(hatching_direction(plane.normal) / std::numbers::sqrt2));
  }
  return caps;
}

json material_header(const MaterialRequest& material) {
  json header = json::object();
  const auto put = [&](const char* key, const std::optional<float>& value) {
    if (value) header[key] = *value;
  };
  put("ambient", material.ambient);
  put("roughness", material.roughness);
  put("specular", material.specular);
  put("shininess", material.shininess);
  return header;
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
              {"components", component_list(meshed)}};
  add_names(header, meshed.atoms);
  for (const RigidMotion& copy : meshed.object.copies) header["copies"].push_back(matrix(copy));
  if (meshed.thickens && meshed.object.coloring.is_translucent()) header["film_opacity"] = true;
  if (!meshed.cut.planes.empty()) header["caps"] = caps_header(meshed.cut);
  if (!meshed.material.empty()) header["material"] = material_header(meshed.material);
  if (const auto& kinds = meshed.object.coloring.kind) {
    json colors = json::array();
    for (const glm::vec3& c : *kinds) colors.push_back(numbers(glm::dvec3(c)));
    header["kind_colors"] = colors;
  }
  return header;
}

/// Adds the arrays of all objects to the file, and returns its header.
json add_objects(MnsWriter& file, std::span<const MeshedObject> objects, const Provenance& provenance,
                 const CutFile& cut) {
  json list = json::array();
  for (const MeshedObject& meshed : objects) {
    if (meshed.mesh.triangles.empty()) continue;
    const std::string prefix = std::to_string(list.size()) + "/";
    const glm::dvec3 origin = mesh_origin(meshed.mesh);
    file.set_prefix(prefix);
    add_mesh(file, meshed.mesh, meshed.mesh.triangles.size() - meshed.cap_plane.size(), origin);
    if (!cut.planes.empty() || !meshed.cut.planes.empty()) add_caps(file, meshed);
    add_map(file, meshed.mesh, meshed.object.coloring);
    add_numbers(file, meshed);
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
              {"device", device_without_threads(provenance.device)},
              {"unit", "angstrom"},
              {"objects", std::move(list)}};
  if (provenance.colors) header["colors"] = color_key_json(*provenance.colors);
  if (!cut.planes.empty()) header["caps"] = caps_header(cut);
  return header;
}

}  // namespace

void write_objects(const std::string& path, Existing existing, std::span<const MeshedObject> objects,
                   const std::optional<Shot>& shot, const Provenance& provenance,
                   const std::optional<PlaceInRun>& place, const CutFile& cut,
                   const std::function<void(std::uint64_t)>& on_size) {
  MnsWriter file(ArrayForm::packed);
  json header = add_objects(file, objects, provenance, cut);
  if (shot) header["camera"] = shot_object(*shot);
  if (place) header["sequence"] = {{"run", place->run}, {"frame", place->frame}, {"scene_frame", place->scene_frame}};
  file.write(path, existing, std::move(header), on_size);
}

void write_objects(OutputFile& file, std::span<const MeshedObject> objects, const Provenance& provenance,
                   const CutFile& cut) {
  MnsWriter arrays(ArrayForm::packed);
  const json header = add_objects(arrays, objects, provenance, cut);
  arrays.write(file, header);
}

}  // namespace meniscus::blender
