// SPDX-License-Identifier: BSD-3-Clause
// The table of trajectory formats, the function that the module for H5MD exports, and the offsets of all frames of a
// file, for formats without an index of their own.
#pragma once

#include <functional>

#include "core/base/binary_file.h"
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

/// The complete frames of a file.
struct FrameIndex {
  std::vector<std::uint64_t> offsets;  ///< byte at which each complete frame begins
  std::string cut_short;               ///< see Trajectory::cut_short()
};

/// The extent of a frame according to its header, or what is wrong with the header.
struct FrameExtent {
  std::uint64_t bytes = 0;    ///< header and data together
  bool has_positions = true;  ///< frames without positions are skipped
  std::string fault;          ///< predicate of a sentence about the frame; empty if the header is good
};

/// Finds the frames of a file by walking from header to header. `extent_at` may return more bytes than are left in the
/// file, but must not read beyond its end. The result is stored in `folder`, which is made if missing; an empty name
/// means no folder. A stored index is used instead of walking as long as path, size and time of change of the file are
/// the same. A folder that cannot be used is ignored. Throws InputError if there is no complete frame, or if the first
/// frame has a fault.
FrameIndex find_frames(BinaryFile& file, const std::string& folder,
                       const std::function<FrameExtent(std::uint64_t offset)>& extent_at);

/// Returns the path of the file in `folder` that stores the index of the trajectory `path`.
std::string frame_index_path(const std::string& folder, const std::string& path);

}  // namespace meniscus
