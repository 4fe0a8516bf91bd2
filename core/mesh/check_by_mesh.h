// SPDX-License-Identifier: BSD-3-Clause
// An independent check of the areas and volumes of a surface: those of its triangles.
#pragma once

namespace meniscus {

struct Surface;

/// Meshes the surface, more finely where a face is thinner than its borders bend, and compares areas and volumes face
/// by face and component by component. Throws OpenSurfaceError with every difference.
void check_by_mesh(const Surface& surface);

}  // namespace meniscus
