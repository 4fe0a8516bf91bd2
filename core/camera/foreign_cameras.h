// SPDX-License-Identifier: BSD-3-Clause
// Cameras of PyMOL and ChimeraX, and how a file's kind of camera is recognized.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

struct Camera;

/// A camera in the words of this program (parse_camera), of PyMOL (the 18 numbers of get_view, with or without
/// set_view(...) around them) or of ChimeraX (`view matrix`: camera and 12 numbers, with or without models behind
/// them), distinguished by content. PyMOL's clipping planes are not taken. A placement of models that all have alike is
/// undone, so that the camera fits the coordinates of their files. ChimeraX tells no angle: its default of 30 degrees
/// between the left and the right edge, which `aspect` (width / height) makes one between the lower and the upper.
/// Throws InputError naming `file`.
Camera parse_any_camera(std::string_view text, const std::string& file, double aspect);

/// parse_any_camera on the content of a file, or on `file` itself where it begins with a brace. Throws InputError.
Camera read_any_camera(const std::string& file, double aspect);

}  // namespace meniscus
