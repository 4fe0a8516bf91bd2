// SPDX-License-Identifier: BSD-3-Clause
// Reads files of volume maps.
#pragma once

#include <string>
#include <string_view>

#include "core/base/text_file.h"
#include "core/volume/volume_grid.h"

namespace meniscus {

/// Reads an OpenDX (as APBS writes it), Gaussian cube or CCP4/MRC file, recognised by its content; gzipped files, too.
/// Throws InputError with file, line and value, and CapacityError.
VolumeGrid read_volume(const std::string& path);

/// Reads OpenDX: a grid of regular positions and connections with its values as text. Coordinates are in Å.
VolumeGrid read_dx(const TextFile& file);

/// Reads a Gaussian cube with one value per point. Lengths are in Bohr, or in Å if the numbers of points are negative.
VolumeGrid read_cube(const TextFile& file);

/// True if these are the bytes of a CCP4 or MRC 2014 map, recognised by its stamp.
bool is_ccp4(std::string_view bytes);

/// Reads CCP4/MRC of modes 0, 1, 2 and 6, in both byte orders and with any order of axes. The origin is ORIGIN if that
/// is not zero (MRC 2014), else NSTART (CCP4).
VolumeGrid read_ccp4(const std::string& path, std::string_view bytes);

}  // namespace meniscus
