// SPDX-License-Identifier: BSD-3-Clause
// Random cameras around molecules and within them, for pictures that must be equal from anywhere.
#pragma once

#include <random>
#include <span>

#include "core/camera/camera.h"
#include "core/surface/primitives.h"

namespace meniscus::testing {

/// Returns a camera outside or not far inside, near or far, every other one orthographic; any way up.
Camera camera_outside(std::span<const Ball> atoms, double aspect, std::mt19937& random);

/// Returns a camera among the atoms, in the solvent where 200 attempts find some; a wide angle, any direction.
Camera camera_inside(std::span<const Ball> atoms, double probe_radius, std::mt19937& random);

}  // namespace meniscus::testing
