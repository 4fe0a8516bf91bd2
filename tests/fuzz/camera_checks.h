// SPDX-License-Identifier: BSD-3-Clause
// Conditions that every accepted camera must meet.
#pragma once

#include "core/camera/camera.h"

namespace meniscus::fuzz {

/// Its axes are orthonormal, rays through the corners of a picture have a direction, and it is valid.
void check_camera(const Camera& camera);

bool same_camera(const Camera& a, const Camera& b);

}  // namespace meniscus::fuzz
