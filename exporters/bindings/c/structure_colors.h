// SPDX-License-Identifier: BSD-3-Clause
// The colours of a molecule's atoms by the name of a scheme.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus::c_api {

/// sRGB, one an atom. Throws Refusal for what is no scheme of single atoms, InputError as color_atoms does; everything
/// where this build has no schemes.
std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme);

}  // namespace meniscus::c_api
