// SPDX-License-Identifier: BSD-3-Clause
// The offsets of all frames of a file, for formats without an index of their own. They may be stored in a folder.
#pragma once

#include <functional>

#include "core/base/binary_file.h"

namespace meniscus {

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
