// SPDX-License-Identifier: BSD-3-Clause
// From where and how large a molecule is wanted in a picture.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// A size and a camera.
struct ViewRequest {
  int width = 1280, height = 960;                   ///< pixels
  std::string camera_file;                          ///< empty: a camera that shows all of the surface
  Projection projection = Projection::perspective;  ///< of that default camera

  glm::ivec2 size() const { return {width, height}; }
};

/// The camera of the file, if one is named. Ask for it before anything is computed. Throws InputError.
std::optional<Camera> given_camera(const ViewRequest& request);

/// The camera given, or the default one, which shows all of the balls.
Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, std::span<const Ball> balls);

}  // namespace meniscus
