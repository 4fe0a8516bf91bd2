// SPDX-License-Identifier: BSD-3-Clause
// The options of exports that write a mesh.
#pragma once

#include <CLI/CLI.hpp>

#include "exporters/mesh/mesh_objects.h"

namespace meniscus {

/// --tolerance and --tolerance-pixels. The request must live as long as the command.
void add_mesh_options(CLI::App& command, MeshRequest& request);

}  // namespace meniscus
