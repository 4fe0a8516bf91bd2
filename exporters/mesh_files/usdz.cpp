// SPDX-License-Identifier: BSD-3-Clause
// Writes USDZ files: USD as text in an uncompressed archive.
#include "exporters/mesh_files/writers.h"
#include "exporters/mesh_files/zip_archive.h"

namespace meniscus {
namespace {

void write_archive(OutputFile& file, std::span<const MeshFile> frames, const RunTimes* times) {
  ZipArchive archive;
  archive.add_stored("molecule.usda", usd_text(frames, times));
  file.write(archive.finish());
}

}  // namespace

void write_usdz(OutputFile& file, const MeshFile& mesh) { write_archive(file, {&mesh, 1}, nullptr); }

void write_usdz_run(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) {
  write_archive(file, frames, &times);
}

}  // namespace meniscus
