// SPDX-License-Identifier: BSD-3-Clause
// Edges too short for the decimals of a file become one vertex.
#pragma once

#include "exporters/msms/msms_mesh.h"

namespace meniscus {

/// Joins the ends of edges shorter than `step` (Å), or whose ends are the same point in multiples of it, at the end
/// with the lower number; their two triangles vanish. An edge stays where joining its ends would leave the mesh open or
/// change its genus: where they have another common neighbour than the two corners across from the edge.
void weld_short_edges(MsmsMesh& mesh, double step);

}  // namespace meniscus
