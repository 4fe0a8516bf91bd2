// SPDX-License-Identifier: BSD-3-Clause
// From a path and the options of a caller to the atoms that the program would use.
#pragma once

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

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

}  // namespace meniscus::c_api
