// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files: the object behind the handle, and functions that some builds refuse.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Refuses what is no such handle.
const Structure& structure_of(const meniscus_structure* structure);

/// Throws Refusal and what read_structure throws; everything where this build has no readers. path: not NULL.
Structure read_file(const char* path, const meniscus_read_options* options);

const meniscus_read_options kReadDefaults{sizeof(meniscus_read_options),
                                          nullptr,
                                          nullptr,
                                          "best",
                                          nullptr,
                                          nullptr,
                                          nullptr,
                                          0,
                                          0,
                                          1,
                                          MENISCUS_HYDROGENS_AUTO,
                                          MENISCUS_UNKNOWN_HALT,
                                          0,
                                          0,
                                          0};

/// sRGB, one an atom. Throws Refusal for what is no scheme of single atoms, InputError as color_atoms does; everything
/// where this build has no schemes.
std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme);

}  // namespace meniscus::c_api
