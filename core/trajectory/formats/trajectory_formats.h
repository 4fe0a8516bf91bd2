// SPDX-License-Identifier: BSD-3-Clause
// The table of trajectory formats, and what the module that reads H5MD gives to the program.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/structure/formats/structure_formats.h"

namespace meniscus {

class Trajectory;
struct TrajectoryOptions;

/// One format. `recognizes` looks at the first kTrajectoryStart bytes of a file, and `open` throws as open_trajectory
/// does.
struct TrajectoryFormat {
  FormatMetadata metadata;
  bool (*recognizes)(std::string_view start);
  std::unique_ptr<Trajectory> (*open)(const std::string& path, const TrajectoryOptions& options);
};

inline constexpr std::size_t kTrajectoryStart = 4096;

/// All formats, in the order they are tried. The last is the models of a structure file, of any format of
/// core/structure/formats/structure_formats.h.
std::span<const TrajectoryFormat* const> trajectory_formats();

/// The name of the format that the file begins like, if it is one of those that hold no atoms of their own: all but the
/// last. Empty for other files, and for one that cannot be read. Throws InputError for a run input file of GROMACS.
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

/// Opens a file. Throws InputError.
using OpenH5md = std::unique_ptr<Trajectory>(const std::string& path);

}  // namespace meniscus
