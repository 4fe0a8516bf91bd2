// SPDX-License-Identifier: BSD-3-Clause
// A camera with its picture, as .mns files and manifests have it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/camera/camera.h"

namespace meniscus::blender {

/// A camera and the picture it is meant for.
struct Shot {
  Camera camera;
  int width = 0, height = 0;  ///< pixels
};

/// The object of a camera file, and the size of the picture.
nlohmann::json shot_object(const Shot& shot);

}  // namespace meniscus::blender
