// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a binary PLY file.
#pragma once

#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/color/coloring.h"
#include "exporters/mesh/triangle_mesh.h"

namespace meniscus {

/// A number per atom that becomes a float property of the vertices.
struct AtomScalar {
  std::string name;  ///< a word of letters, digits and underscores
  std::vector<float> values;
};

/// Writes one mesh: float vertex properties x y z nx ny nz, colours red green blue (uchar, sRGB), the scalars, kind and
/// component; faces as lists of three indices. Coordinates are Å as in the input file. Throws
/// OutputError.
void write_ply(const std::string& path, Existing existing, const TriangleMesh& mesh, const Coloring& coloring,
               const std::vector<AtomScalar>& scalars);

}  // namespace meniscus
