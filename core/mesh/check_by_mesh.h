// SPDX-License-Identifier: BSD-3-Clause
// Checks the areas and volumes of a surface independently, by the triangles of its meshes.
#pragma once

namespace meniscus {

struct Surface;

/// Meshes the surface and compares the areas of faces and the volumes of components with those of their triangles.
/// Where a face is thinner than its borders bend, finer meshes are tried. Throws OpenSurfaceError with the first
/// difference.
void check_by_mesh(const Surface& surface);

}  // namespace meniscus
