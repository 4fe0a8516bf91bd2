// SPDX-License-Identifier: BSD-3-Clause
// A mesh of many colours as one mesh a colour, for formats whose vertices have none.
#pragma once

#include <vector>

#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// In the order in which colours occur; those that are alike in sRGB of 8 bits a channel are one, that which it is
/// there. The colour of a triangle is that of its corners, which is one.
std::vector<SceneMesh> split_colors(const SceneMesh& mesh);

}  // namespace meniscus::path_tracers
