// SPDX-License-Identifier: BSD-3-Clause
// The text of a scene for pbrt-v4 (M. Pharr, W. Jakob & G. Humphreys, "Physically based rendering", 4th edition, 2023;
// its documentation, "pbrt-v4 input file format").
#pragma once

#include <string>

#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// Mesh n of the scene, from 1, counted over all items, is the file <name>_<n>.ply; each has one colour.
std::string pbrt_text(const Scene& scene, const std::string& name);

}  // namespace meniscus::path_tracers
