// SPDX-License-Identifier: BSD-3-Clause
// Refuses 3MF and USDZ files, which are zip archives, in builds without libdeflate.
#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

[[noreturn]] void refuse(std::string_view format) {
  throw RequestError(
      fmt::format("this build writes no {} files: it was made without libdeflate; choose another format", format));
}

}  // namespace

void write_3mf(OutputFile&, const MeshFile&) { refuse("3MF"); }
void write_usdz(OutputFile&, const MeshFile&) { refuse("USDZ"); }
void write_usdz_run(OutputFile&, std::span<const MeshFile>, const RunTimes&) { refuse("USDZ"); }

}  // namespace meniscus
