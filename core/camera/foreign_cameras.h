// SPDX-License-Identifier: BSD-3-Clause
// Reads cameras of PyMOL and ChimeraX, and recognizes a file's kind of camera.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

struct Camera;

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
