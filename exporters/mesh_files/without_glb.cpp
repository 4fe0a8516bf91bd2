// SPDX-License-Identifier: BSD-3-Clause
// Refuses GLB files, in builds without JSON for Modern C++.
#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

void write_glb(OutputFile&, const MeshFile&) {
  throw RequestError("this build writes no GLB files: it was made without nlohmann_json; choose another format");
}

}  // namespace meniscus
