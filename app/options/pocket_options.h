// SPDX-License-Identifier: BSD-3-Clause
// The options that say what a pocket is.
#pragma once

#include <CLI/CLI.hpp>

#include "app/options/molecule_options.h"
#include "core/pockets/pockets.h"

namespace meniscus {

/// --probe, --large-probe, --trim, --min-volume, --mouth-tolerance.
void add_pocket_options(CLI::App& command, SurfaceRequest& surface, PocketRequest& pockets);

}  // namespace meniscus
