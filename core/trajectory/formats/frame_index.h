// SPDX-License-Identifier: BSD-3-Clause
// The places where the frames of a file begin, for formats without an index; kept for the next time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/binary_file.h"

namespace meniscus {

struct FrameIndex {
  std::vector<std::uint64_t> offsets;  ///< where each whole frame begins
  std::string cut_short;               ///< as Trajectory::cut_short()
};

/// What the header of a frame says, or the first words of what is wrong with it.
struct FrameExtent {
  std::uint64_t bytes = 0;    ///< header and data
  bool has_positions = true;  ///< false: to be passed over
  std::string fault;          ///< empty: a good header
};

/// Walks through the frames of a file by their headers; `extent_at` may name more bytes than the file has left, and
/// never reads behind its end. With a `folder`, made when missing, the result is kept there, and used instead of
/// walking while path, size and time of the file are as they were. A folder that cannot be used does no harm. Throws
/// InputError: no whole frame, or a first frame with a fault.
FrameIndex find_frames(BinaryFile& file, const std::string& folder,
                       const std::function<FrameExtent(std::uint64_t offset)>& extent_at);

/// The file in `folder` that keeps the index of the trajectory `path`.
std::string frame_index_path(const std::string& folder, const std::string& path);

}  // namespace meniscus
