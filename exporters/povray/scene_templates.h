// SPDX-License-Identifier: BSD-3-Clause
// The constant parts of every scene: the files of exporters/povray/templates.
#pragma once

#include <span>

#include "core/base/text.h"

namespace meniscus {

/// Returns the templates of scenes, with the marks that are replaced in each:
///  main.pov      settings and lights, after the camera: NAME of the scene, SHADOWS, SOFTNESS;
///  surface.pov   a surface: GROUP ("union" or "object"), GEOMETRY and CAPS (#include statements for their files), and
///                HANDLE, the name it gets in a user's own scene;
///  map.inc       functions and colours of a volume map: FILE and the numbers that append_map() gives;
///  caps.inc      definitions before caps: DARK, the light of hatching;
///  shapes.inc    definitions before shapes;
///  frame.inc     the choice of a frame's include, after the list of frames of a run: NAME, PART, NAMED;
///  style.inc     lights and materials, after the colours;
///  buffers.inc   the buffers, after the extent of the molecule;
///  settings.ini  settings after the sizes: NAME, and PICTURE, the text between the name and the number of a picture;
///  film.ini      settings of a run, after settings.ini: NAME, COUNT of frames;
///  story.pov, story.ini  a film (story.h): NAME, WIDTH, HEIGHT, COUNT, RATE.
std::span<const TemplateFile> povray_templates();

}  // namespace meniscus
