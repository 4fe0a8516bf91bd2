// SPDX-License-Identifier: BSD-3-Clause
// The colours of a mesh's triangles and vertices under a Coloring.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/color/coloring.h"

namespace meniscus {

struct TriangleMesh;

/// sRGB of a triangle: that of its patch kind or of its atom.
glm::vec3 triangle_color(const TriangleMesh& mesh, const Coloring& coloring, std::size_t triangle);

/// sRGB per vertex: the mean of the triangles around it, which blends colours over one triangle; with a volume map its
/// colour there.
std::vector<glm::vec3> vertex_colors(const TriangleMesh& mesh, const Coloring& coloring);

/// Per vertex what the map says there; NaN outside of it.
std::vector<float> vertex_map_values(const TriangleMesh& mesh, const VolumePaint& volume);

/// Per vertex the atom of one of its triangles (the one with the lowest index), for scalars of atoms.
std::vector<std::uint32_t> vertex_atoms(const TriangleMesh& mesh);

/// The middle of the mesh's bounding box rounded to whole Å: coordinates written in single precision are relative to
/// it, so that rounding costs less than 1e-5 Å anywhere within 150 Å of it, wherever the molecule lies.
glm::dvec3 mesh_origin(const TriangleMesh& mesh);

}  // namespace meniscus
