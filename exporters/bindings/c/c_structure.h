// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files: the object behind the handle, and functions that refuse every call in builds without some
// libraries.
#pragma once

#include <string_view>

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Returns the molecule of a handle, which is valid as long as the handle. Refuses NULL: like every refusal of this
/// interface, that throws a Refusal (c_calls.h) with status and message.
const Structure& structure_of(const meniscus_structure* structure);

/// Reads a molecule with the options of a caller, or the defaults for NULL. `path` must not be NULL. Refuses impossible
/// options; throws the exceptions of read_structure(). Builds without gemmi refuse every call.
Structure read_file(const char* path, const meniscus_read_options* options);

/// The defaults of meniscus_read_options, in the order of its members: size, select, assembly, altloc, radii,
/// radii_files, radius, radii_file_count, radius_count, model, hydrogens, unknown_element, keep_water, keep_ions,
/// reserved.
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

/// Returns the sRGB colours of the atoms. `scheme` is a word of --color. Refuses an unknown scheme, and one that needs
/// more than the atoms, such as a surface, frames or a file of numbers. Throws InputError if the atoms do not have the
/// numbers of the scheme. Builds without nlohmann_json or FreeType refuse every call.
std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme);

}  // namespace meniscus::c_api
