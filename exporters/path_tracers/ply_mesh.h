// SPDX-License-Identifier: BSD-3-Clause
// A mesh of a scene as binary PLY.
#pragma once

#include "core/base/output_file.h"
#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// Positions, normals and, where asked for, colours as floats r, g, b, which Mitsuba reads as "vertex_color".
void write_mesh(OutputFile& file, const SceneMesh& mesh, bool with_colors);

}  // namespace meniscus::path_tracers
