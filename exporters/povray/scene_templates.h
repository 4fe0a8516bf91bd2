// SPDX-License-Identifier: BSD-3-Clause
// The constant parts of every scene: materials, and the buffers that let users check the geometry.
#pragma once

#include <string_view>

namespace meniscus::povray {

/// The .pov after the camera: settings, lights and the surface; "@NAME@" stands for the scene's name, "@GROUP@" for
/// union or object, "@GEOMETRY@" for the file to include.
extern const std::string_view kMainTemplate;
/// Of a run: from the scene's frame to the file to include, behind the list of frames.
extern const std::string_view kFrameTemplate;
/// The style include after the colours.
extern const std::string_view kStyleTemplate;
/// The buffer include; complete but for the extent of the molecule, which comes before.
extern const std::string_view kBufferTemplate;
/// The .ini after the sizes; "@NAME@" as above, "@PICTURE@" for what pictures of frames have between name and number.
extern const std::string_view kIniTemplate;

}  // namespace meniscus::povray
