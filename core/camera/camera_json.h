// SPDX-License-Identifier: BSD-3-Clause
// Cameras and camera paths in files: as JSON, and as PyMOL and ChimeraX write them.
#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// Parses {"position":[x,y,z],"target":[..],"up":[..],"projection":"perspective","vertical_fov":degrees} or
/// {..,"projection":"orthographic","height":Å}. Position and target are in Å; `up` is a direction. `file` is for
/// messages. Throws InputError for anything missing, unknown or impossible (position equal to target, up parallel to
/// the view, angle not inside (0, 180), height not positive).
Camera parse_camera(std::string_view json, const std::string& file);

/// Formats a camera as parse_camera reads it: every number is preserved exactly. Ends with a newline.
std::string camera_json(const Camera& camera);
nlohmann::ordered_json camera_object(const Camera& camera);

/// Parses {"keys":[{"frame":0,"camera":{...}},...]}, with each camera as in parse_camera. `file` is for messages.
/// Throws InputError, which names the key, also unless frames increase from key to key and all cameras have one
/// projection.
CameraPath parse_camera_path(std::string_view json, const std::string& file);
/// Parses the content of the file with this path by parse_camera_path(). Throws InputError, also if it cannot be read.
CameraPath read_camera_path(const std::string& file);

/// Formats keys as parse_camera_path reads them: every number is preserved exactly. Ends with a newline.
std::string camera_path_json(const std::vector<CameraKey>& keys);
nlohmann::ordered_json camera_path_object(const std::vector<CameraKey>& keys);

/// Parses a camera of this program (parse_camera), of PyMOL or of ChimeraX; the content decides which.
///  PyMOL: the 18 numbers of get_view, with or without set_view(...) around them. Its clipping planes are ignored.
///  ChimeraX: the text of `view matrix`, which is the camera as 12 numbers, with or without the motions of models
///    after it. The camera is moved back by the motion that all models share, so that it fits the coordinates of the
///    models' files. ChimeraX reports no angle, so its default applies: 30 degrees between the left and the right edge,
///    which `aspect` (width / height) converts to the angle between the lower and the upper edge.
///  `file` is for messages. Throws InputError, also if models have different motions.
Camera parse_any_camera(std::string_view text, const std::string& file, double aspect);

/// Parses a camera that a user gave, with parse_any_camera: the content of the file with this path or, if the text
/// begins with a brace, the text itself. Throws InputError, also if the file cannot be read.
Camera read_any_camera(const std::string& file, double aspect);

}  // namespace meniscus
