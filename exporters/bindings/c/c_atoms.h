// SPDX-License-Identifier: BSD-3-Clause
// Positions and radii passed by other programs.
#pragma once

#include <vector>

#include "core/surface/primitives.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Throws Refusal, naming the atom and the value, for whatever meniscus.h does not allow.
std::vector<Ball> read_atoms(const meniscus_atoms* atoms);

}  // namespace meniscus::c_api
