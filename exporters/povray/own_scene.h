// SPDX-License-Identifier: BSD-3-Clause
// The include file that declares a surface in a scene that the user wrote.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace meniscus::povray {

/// Returns the text of <name>.inc, which includes <name>.pov. It declares those of Meniscus_Surface, Meniscus_Shapes,
/// Meniscus_Object_1, ... that the scene has, and places nothing. Names that were declared before it stay as they were;
/// all other names are undefined at its end. texts: the text of <name>.pov and of the files it includes, except the
/// templates for caps, shapes and maps and the lists of colours, which are always searched for names. maps: true if
/// each frame of a run may have a volume map.
std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps = false);

}  // namespace meniscus::povray
