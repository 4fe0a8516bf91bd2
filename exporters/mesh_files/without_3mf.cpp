// SPDX-License-Identifier: BSD-3-Clause
// Refuses 3MF files, which are compressed, in builds without libdeflate.
#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

void write_3mf(OutputFile&, const MeshFile&) {
  throw RequestError("this build writes no 3MF files: it was made without libdeflate; choose another format");
}

}  // namespace meniscus
