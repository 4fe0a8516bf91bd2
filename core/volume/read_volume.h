// SPDX-License-Identifier: BSD-3-Clause
// Reads files of volume maps.
#pragma once

#include <string>
#include <string_view>

#include "core/base/text_file.h"
#include "core/volume/volume_grid.h"

namespace meniscus {

/// Reads OpenDX (as APBS writes it), Gaussian cube or CCP4/MRC, by content; gzipped too. Throws InputError naming file,
/// line and value, CapacityError.
VolumeGrid read_volume(const std::string& path);

/// OpenDX: a grid of regular positions and connections, its values as text. Coordinates in Å.
VolumeGrid read_dx(const TextFile& file);

/// Gaussian cube: one value a point. Lengths in Bohr, or in Å where the numbers of points are negative.
VolumeGrid read_cube(const TextFile& file);

/// Whether these are the bytes of a CCP4 or MRC 2014 map, by its stamp.
bool is_ccp4(std::string_view bytes);

/// CCP4/MRC of modes 0, 1, 2 and 6, of both byte orders and any order of axes. Its place is ORIGIN where that is not
/// zero (MRC 2014), else NSTART (CCP4).
VolumeGrid read_ccp4(const std::string& path, std::string_view bytes);

}  // namespace meniscus
