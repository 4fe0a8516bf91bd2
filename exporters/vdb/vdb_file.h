// SPDX-License-Identifier: BSD-3-Clause
// Level sets as files of OpenVDB.
#pragma once

#include <string>

#include "core/base/output_file.h"
#include "core/queries/distance_band.h"

namespace meniscus {

/// A grid "surface" of floats: distances in the band are its active voxels, and beyond it are its ends, negative
/// inside. scale: length of 1 Å in the file, of distances too. about: one line.
struct VdbFile {
  double scale = 1.0;
  std::string about;
};

/// Writes all of the file but does not commit it: version 224, which OpenVDB reads since 3.0 (K. Museth, "VDB:
/// high-resolution sparse volumes with dynamic topology", ACM TOG 32 (2013), and OpenVDB's io). Without compression but
/// for voxels that are not active, so that no library is needed.
void write_vdb(OutputFile& file, const DistanceBand& band, const VdbFile& about);

}  // namespace meniscus
