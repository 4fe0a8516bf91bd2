// SPDX-License-Identifier: BSD-3-Clause
// The text of a scene for Mitsuba 3 (W. Jakob et al., "Mitsuba 3 renderer", 2022; its documentation, "Scene XML file
// format").
#pragma once

#include <string>

#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// Mesh n of the scene, from 1, counted over all items, is the file <name>_<n>.ply with colours.
std::string mitsuba_text(const Scene& scene, const std::string& name);

}  // namespace meniscus::path_tracers
