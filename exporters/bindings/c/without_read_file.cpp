// SPDX-License-Identifier: BSD-3-Clause
// Refuses molecule files, in builds without gemmi, whose tables of elements and residues all readers need.
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_structure.h"

namespace meniscus::c_api {

Structure read_file(const char* path, const meniscus_read_options*) {
  refuse(MENISCUS_USAGE, "{}: this build reads no molecule files: it was made without gemmi; give positions and radii",
         path);
}

}  // namespace meniscus::c_api
