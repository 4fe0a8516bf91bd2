// SPDX-License-Identifier: BSD-3-Clause
// Adds the size to the camera's object.
#include "core/camera/camera_json.h"
#include "exporters/blender/shot.h"

#include <nlohmann/json.hpp>

namespace meniscus::blender {

nlohmann::json shot_object(const Shot& shot) {
  nlohmann::json camera = camera_object(shot.camera);
  camera["size"] = {shot.width, shot.height};
  return camera;
}

}  // namespace meniscus::blender
