// SPDX-License-Identifier: BSD-3-Clause
// Conditions that every accepted camera must meet.
#pragma once

#include "core/camera/camera.h"

namespace meniscus::fuzz {

/// Checks that a camera is valid, its axes are orthonormal, and rays through the corners of a picture have a direction.
void check_camera(const Camera& camera);

bool same_camera(const Camera& a, const Camera& b);

}  // namespace meniscus::fuzz
