// SPDX-License-Identifier: BSD-3-Clause
// Writes level sets as OpenVDB files.
#pragma once

#include "core/base/output_file.h"
#include "core/queries/distance.h"

namespace meniscus {

/// The unit and the description of a VDB file.
struct VdbFile {
  double scale = 1.0;  ///< length of 1 Å in the unit of the file, for coordinates and distances
  std::string about;   ///< one line
};

/// Writes the whole file but does not commit it. The grid "surface" contains floats: distances within the band are
/// active voxels, and voxels beyond it have the half-width of the band, negative inside. The file has version 224,
/// which OpenVDB reads since 3.0 (K. Museth, "VDB: high-resolution sparse volumes with dynamic topology", ACM TOG 32
/// (2013), and OpenVDB's io). Only inactive voxels are compressed, so that no library is needed.
void write_vdb(OutputFile& file, const DistanceBand& band, const VdbFile& about);

}  // namespace meniscus
