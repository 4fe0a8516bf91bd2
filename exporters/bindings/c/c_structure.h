// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files: the object behind the handle, and functions that some builds refuse.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Returns the molecule of a handle. Refuses NULL.
const Structure& structure_of(const meniscus_structure* structure);

/// Reads a molecule with the options of a caller, or the defaults for NULL. path: not NULL. Refuses impossible options;
/// throws the exceptions of read_structure(). Builds without readers refuse every call.
Structure read_file(const char* path, const meniscus_read_options* options);

/// The defaults of meniscus_read_options.
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

/// Returns the sRGB colours of the atoms. Refuses an unknown scheme, and one that needs more than the atoms; throws the
/// exceptions of color_atoms(). Builds without schemes refuse every call.
std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme);

}  // namespace meniscus::c_api
