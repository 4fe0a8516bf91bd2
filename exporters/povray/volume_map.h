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

/// The end of the map file's name, after the name of the scene.
inline constexpr std::string_view kMapFileEnding = "_map.df3";

/// Writes the values as a density file (df3) of POV-Ray: integers of 32 bits that span the range from the least value
/// to the greatest. Fewer bits would not do, because potentials inside molecules are far greater than the range of
/// colours. Throws RequestError for more than 65,535 points along an axis, the most that the format can count.
void write_density(const VolumeGrid& grid, const std::function<void(std::string_view)>& write);

/// Appends the colours of the map and the function Meniscus_Map(x,y,z), which returns 0 outside of the map and a place
/// in the colours inside it. file: the name of the file that write_density() wrote. origin: the origin of the scene's
/// coordinates, in Å.
void append_map(SceneText& out, const VolumePaint& paint, std::string_view file, const glm::dvec3& origin);

}  // namespace meniscus::povray
