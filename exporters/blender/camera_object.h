// SPDX-License-Identifier: BSD-3-Clause
// A camera as .mns files and manifests have it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// That of a camera file, and the size of the picture.
nlohmann::json camera_object(const Shot& shot);

}  // namespace meniscus::blender
