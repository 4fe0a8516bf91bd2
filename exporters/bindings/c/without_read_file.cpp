// SPDX-License-Identifier: BSD-3-Clause
// Replaces read_file.cpp in builds without gemmi, which all readers need, and refuses every call.
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_structure.h"

namespace meniscus::c_api {

Structure read_file(const char* path, const meniscus_read_options*) {
  refuse(MENISCUS_USAGE, "{}: this build reads no molecule files: it was made without gemmi; give positions and radii",
         path);
}

}  // namespace meniscus::c_api
