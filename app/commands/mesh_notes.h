// SPDX-License-Identifier: BSD-3-Clause
// The common part of commands that write meshes: notes on size and fineness, refusals, and the attribute buried_area.
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

/// True if the command line or the scene sets the fineness of a mesh.
bool has_fineness(const SceneOptions& options);

/// The choice whether each copy of an object has triangles of its own.
enum class CopiesOfMesh { own, shared };

/// Returns the approximate number of triangles of some objects.
double expected_triangles(std::span<const SurfaceObject> objects, const MeshFineness& fineness, CopiesOfMesh copies);

/// Prints a warning before a mesh is made, if it is expected to be very large, unless quiet.
void warn_of_many(const SceneCommand& command, double expected_triangles);

/// Returns "within 0.05 Å of the surface", or the other fineness that was requested.
std::string fineness_words(const MeshRequest& request, const MeshFineness& fineness);

/// Throws RequestError if an even mesh would have to end at atoms that --show leaves out, or at planes.
void refuse_even_parts(const MeshFineness& fineness, bool has_hidden_atoms, bool is_cut);

/// Returns the area of each atom that other chains bury, Å²; empty if `names` does not contain "buried_area". A
/// molecule with copies has no such areas: then the name is removed from a list of all names, and refused by
/// RequestError in any other list.
std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all);

}  // namespace meniscus
