// SPDX-License-Identifier: BSD-3-Clause
// The include file that brings a surface into somebody's own scene.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace meniscus::povray {

/// <name>.inc: declares Meniscus_Surface, Meniscus_Shapes and Meniscus_Object_1, ..., as far as the scene has them, and
/// places nothing. What was declared before stays; all other names are taken back. name: of <name>.pov, which it
/// includes. texts: that file, and those which it includes, as far as their names are their own. maps: of a run each
/// frame may bring a volume map.
std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps = false);

}  // namespace meniscus::povray
