// SPDX-License-Identifier: BSD-3-Clause
// The options that draw atoms beside the surface: --sticks, --balls, --spheres, --tube and their radii.
#pragma once

#include <CLI/CLI.hpp>

#include "core/scene/representations.h"

namespace meniscus {

/// The request must live as long as the command.
void add_representation_options(CLI::App& command, Representations& representations);

}  // namespace meniscus
