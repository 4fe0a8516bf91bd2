// SPDX-License-Identifier: BSD-3-Clause
// What commands that write meshes share: what they say of size and fineness, what they refuse, and the attribute
// buried_area.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/surface_object.h"
#include "core/scene/molecule.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Whether the command line or the scene says how fine a mesh is.
bool has_fineness(const SceneOptions& options);

/// Whether each copy of an object gets triangles of its own.
enum class CopiesOfMesh { own, shared };

/// About how many the meshes of some objects will have.
double expected_triangles(std::span<const SurfaceObject> objects, const MeshFineness& fineness, CopiesOfMesh copies);

/// Before a mesh is made: a warning on stderr if it is expected to be very large, unless quiet.
void warn_of_many(const SceneCommand& command, double expected_triangles);

/// "within 0.05 Å of the surface", or what else was asked for.
std::string fineness_words(const MeshRequest& request, const MeshFineness& fineness);

/// Throws RequestError where an even mesh would have to end at atoms that --show leaves out, or at planes.
void refuse_even_parts(const MeshFineness& fineness, bool has_hidden_atoms, bool is_cut);

/// The area of each atom that other chains bury, Å²; empty where `names` does not have "buried_area". Of a molecule
/// with copies, for which it cannot be said, the name goes from a list of all names, and is refused by RequestError in
/// any other.
std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all);

}  // namespace meniscus
