// SPDX-License-Identifier: BSD-3-Clause
// Cameras and camera paths in files: as JSON, and as PyMOL and ChimeraX write them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// Parses {"position":[x,y,z],"target":[..],"up":[..],"projection":"perspective","vertical_fov":degrees} or
/// {..,"projection":"orthographic","height":Å}. Throws InputError naming `file` for anything missing, unknown or
/// impossible (position equal to target, up parallel to the view, angle not inside (0, 180), height not positive).
Camera parse_camera(std::string_view json, const std::string& file);

/// Formats a camera as parse_camera reads it: every number is preserved exactly. Ends with a newline.
std::string camera_json(const Camera& camera);
/// Returns a camera as a JSON object.
nlohmann::ordered_json camera_object(const Camera& camera);

/// Parses {"keys":[{"frame":0,"camera":{...}},...]}, with each camera as in parse_camera. Throws InputError naming
/// `file` and the key.
CameraPath parse_camera_path(std::string_view json, const std::string& file);
CameraPath read_camera_path(const std::string& file);

/// Formats keys as parse_camera_path reads them: every number is preserved exactly. Ends with a newline.
std::string camera_path_json(const std::vector<CameraKey>& keys);
/// Returns keys as a JSON object.
nlohmann::ordered_json camera_path_object(const std::vector<CameraKey>& keys);

/// Parses a camera of this program (parse_camera), of PyMOL (the 18 numbers of get_view, with or without set_view(...)
/// around them) or of ChimeraX (`view matrix`: camera and 12 numbers, with or without models after them); the content
/// decides which. PyMOL's clipping planes are ignored. If all models have the same placement, it is undone, so that the
/// camera fits the coordinates of their files. ChimeraX reports no angle, so its default applies: 30 degrees between
/// the left and the right edge, which `aspect` (width / height) converts to the angle between the lower and the upper
/// edge. Throws InputError naming `file`.
Camera parse_any_camera(std::string_view text, const std::string& file, double aspect);

/// Parses the content of a file with parse_any_camera, or `file` itself if it begins with a brace. Throws InputError.
Camera read_any_camera(const std::string& file, double aspect);

}  // namespace meniscus
