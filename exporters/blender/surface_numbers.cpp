// SPDX-License-Identifier: BSD-3-Clause
// Computes curvatures of vertices, areas of the patches of triangles, and areas of atoms.
#include "exporters/blender/surface_numbers.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/mesh_attributes.h"
#include "core/mesh/open_sky.h"
#include "core/queries/surface_point.h"
#include "core/surface/atom_areas.h"
#include "exporters/mesh_files/vertex_numbers.h"

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

}  // namespace meniscus::blender
