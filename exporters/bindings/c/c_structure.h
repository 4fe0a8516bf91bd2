// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files: the object behind the handle, and colours of its atoms, which some builds refuse.
#pragma once

#include <string_view>

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Returns the molecule of a handle, which is valid as long as the handle. Refuses NULL: like every refusal of this
/// interface, that throws a Refusal (c_calls.h) with status and message.
const Structure& structure_of(const meniscus_structure* structure);

/// Returns the sRGB colours of the atoms. `scheme` is a word of --color. Refuses an unknown scheme, and one that needs
/// more than the atoms, such as a surface, frames or a file of numbers. Throws InputError if the atoms do not have the
/// numbers of the scheme. Builds without nlohmann_json or FreeType refuse every call.
std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme);

}  // namespace meniscus::c_api
