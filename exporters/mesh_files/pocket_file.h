// SPDX-License-Identifier: BSD-3-Clause
// Pockets as objects of a mesh file, each in its colour.
#pragma once

#include "exporters/mesh_files/mesh_file.h"

namespace meniscus {

struct TriangleMesh;

/// mesh: as pocket_mesh() makes it. Objects are named "pocket 1", ... by rank and have the rank as vertex number
/// "pocket"; colours are those of categorical_color(). Lengths are in Å. No atoms, no inner points: for formats that
/// need neither.
MeshFile pocket_file(const TriangleMesh& mesh);

}  // namespace meniscus
