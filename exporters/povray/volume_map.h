// SPDX-License-Identifier: BSD-3-Clause
// A volume map in a scene: its values as a density file, and the functions that colour points by them.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/color/color_maps.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// Behind the scene's name.
inline constexpr std::string_view kMapFileEnding = "_map.df3";

/// Writes the values as POV-Ray's df3: whole numbers of 32 bits from the least value to the greatest, for potentials
/// are far greater within molecules than the range of colours. Throws RequestError for more points along an axis than
/// it can count (65,535).
void write_density(const VolumeGrid& grid, const std::function<void(std::string_view)>& write);

/// Declares the colours of the map, and Meniscus_Map(x,y,z): 0 where it does not reach, else a place in them. file:
/// what write_density() made. origin: Å, of the scene's coordinates.
void append_map(SceneText& out, const VolumePaint& paint, std::string_view file, const glm::dvec3& origin);

}  // namespace meniscus::povray
