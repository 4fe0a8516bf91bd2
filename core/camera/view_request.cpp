// SPDX-License-Identifier: BSD-3-Clause
// Finds the camera that a request means.
#include "core/camera/view_request.h"

namespace meniscus {

std::optional<Camera> given_camera(const ViewRequest& request) {
  if (request.camera_file.empty()) return {};
  return read_camera(request.camera_file);
}

Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, std::span<const Ball> balls) {
  if (given) return *given;
  return frame_camera(balls, static_cast<double>(request.width) / request.height, request.projection);
}

}  // namespace meniscus
