// SPDX-License-Identifier: BSD-3-Clause
// The table of trajectory formats, and the function that the module for H5MD exports.
#pragma once

#include "core/structure/formats/structure_formats.h"

namespace meniscus {

class Trajectory;
struct TrajectoryOptions;

/// A trajectory format. `recognizes` is called with the first kTrajectoryStart bytes of a file. `open` throws as
/// open_trajectory does.
struct TrajectoryFormat {
  FormatMetadata metadata;
  bool (*recognizes)(std::string_view start);
  std::unique_ptr<Trajectory> (*open)(const std::string& path, const TrajectoryOptions& options);
};

/// The number of bytes by which a format is recognized.
inline constexpr std::size_t kTrajectoryStart = 4096;

/// Returns all formats in the order in which they are tried. The last one is the models of structure files in any
/// format of core/structure/formats/structure_formats.h.
std::span<const TrajectoryFormat* const> trajectory_formats();

/// Returns the name of the format that a file begins like, if files of this format have no names of atoms. These are
/// all formats except the last. The result is empty for other files and for files that cannot be read. Throws
/// InputError for a run input file of GROMACS.
std::string_view bare_trajectory_format(const std::string& path);

extern const TrajectoryFormat kDcdFormat;
extern const TrajectoryFormat kXtcFormat;
extern const TrajectoryFormat kTrrFormat;
extern const TrajectoryFormat kAmberNetcdfFormat;
extern const TrajectoryFormat kH5mdFormat;
extern const TrajectoryFormat kLammpsFormat;
extern const TrajectoryFormat kMdcrdFormat;
extern const TrajectoryFormat kAmberRestartFormat;
extern const TrajectoryFormat kNamdCoordinatesFormat;
extern const TrajectoryFormat kModelsFormat;

/// A function that opens an H5MD file. It throws InputError.
using OpenH5md = std::unique_ptr<Trajectory>(const std::string& path);

}  // namespace meniscus
