// SPDX-License-Identifier: BSD-3-Clause
// The constant parts of every scene: the files of exporters/povray/templates.
#pragma once

#include <span>

#include "core/base/text.h"

namespace meniscus {

/// main.pov: what is behind the camera: settings and lights; mark: NAME of the scene. surface.pov: a surface; marks:
/// GROUP (union or object), GEOMETRY and CAPS (what includes their files). map.inc: after the numbers of a volume map;
/// mark: FILE. caps.inc: before caps; mark: DARK, the light of hatching. shapes.inc: before shapes. frame.inc: of a
/// run, from the scene's frame to the file to include, after the list of frames; mark: NAME. style.inc: behind the
/// colours. buffers.inc: all but the extent of the molecule, which comes before. settings.ini: after the sizes; marks:
/// NAME, and PICTURE, what pictures of frames have between name and number. film.ini: of a run, behind that; marks:
/// NAME, COUNT of frames. story.pov, story.ini: of a film (story.h); marks: NAME, WIDTH, HEIGHT, COUNT, RATE.
std::span<const TemplateFile> povray_templates();

}  // namespace meniscus
