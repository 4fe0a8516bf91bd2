// SPDX-License-Identifier: BSD-3-Clause
// Texts about the fineness of meshes, warnings of large ones, and buried areas between chains.
#include "app/commands/mesh_notes.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/reports/notes.h"
#include "core/base/error.h"

namespace meniscus {
namespace {

constexpr double kManyTriangles = 1e7;

}  // namespace

bool has_fineness(const SceneOptions& options) {
  return options.is_given("mesh.tolerance") || options.is_given("mesh.tolerance_pixels") ||
         options.is_given("mesh.density");
}

double expected_triangles(std::span<const SurfaceObject> objects, const MeshFineness& fineness, CopiesOfMesh copies) {
  double triangles = 0.0;
  for (const SurfaceObject& object : objects)
    triangles += (copies == CopiesOfMesh::own ? static_cast<double>(object.copies.size()) : 1.0) *
                 estimated_triangles(object.surface, fineness);
  return triangles;
}

void warn_of_many(const SceneCommand& command, double expected_triangles) {
  if (expected_triangles > kManyTriangles)
    say(command, fmt::format("warning: about {:.0f} million triangles; a larger --tolerance or a smaller "
                             "--density makes fewer",
                             expected_triangles / 1e6));
}

std::string fineness_words(const MeshRequest& request, const MeshFineness& fineness) {
  if (fineness.density > 0.0) return fmt::format("{:g} vertices per Å²", fineness.density);
  if (fineness.tolerance_at)
    return fmt::format("within {:g} pixels of the surface, {:.4g} Å or more", request.tolerance_pixels,
                       fineness.tolerance);
  return fmt::format("within {:.4g} Å of the surface", fineness.tolerance);
}

void refuse_even_parts(const MeshFineness& fineness, bool has_hidden_atoms, bool is_cut) {
  if (!fineness.even && fineness.density == 0.0) return;
  if (has_hidden_atoms)
    throw RequestError(
        "triangles of an even mesh cross the borders of atoms, so --show cannot cut it; leave --even and --density "
        "out, or choose atoms by --select");
  if (is_cut)
    throw RequestError("planes cut a mesh whose triangles keep to patches; leave --even and --density out, or --clip");
}

std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all) {
  const auto wanted = std::ranges::find(names, "buried_area");
  if (wanted == names.end()) return {};
  if (!structure.instances.empty()) {
    if (!all) throw RequestError("areas buried between copies need copies made of atoms; leave --instances out");
    names.erase(wanted);
    return {};
  }
  SurfaceComputer computer(molecule.surface);
  return buried_areas(structure, group_atoms(structure, Grouping::chain), computer, molecule.surface.kind);
}

}  // namespace meniscus
