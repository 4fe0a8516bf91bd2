// SPDX-License-Identifier: BSD-3-Clause
// The options of exports that write a mesh, and the one way from them to the mesh.
#pragma once

#include <span>
#include <vector>

#include "app/molecule.h"
#include "app/options/picture_options.h"
#include "exporters/mesh/triangle_mesh.h"

namespace meniscus {

/// What the mesh options say.
struct MeshCommandOptions {
  double tolerance = 0.01;        ///< Å
  double tolerance_pixels = 0.0;  ///< > 0: of a picture, instead of Å
};

/// --tolerance and --tolerance-pixels.
void add_mesh_options(CLI::App& command, MeshCommandOptions& options);

/// The tolerance in Å: as given, or what --tolerance-pixels means at the nearest ball in this picture.
double tolerance_of(const MeshCommandOptions& options, const PictureOptions& picture, const Camera& camera,
                    std::span<const Ball> balls);

/// Meshes what is shown of each object. Throws RequestError when no triangle came out.
std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance);
/// The same, and says on stderr how many triangles came out.
std::vector<TriangleMesh> meshes_of(const MoleculeOptions& options, std::span<const SurfaceObject> objects,
                                    double tolerance);

}  // namespace meniscus
