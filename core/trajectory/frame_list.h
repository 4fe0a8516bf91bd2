// SPDX-License-Identifier: BSD-3-Clause
// Lists of frames as users write them, such as "0-99:10,250", and tables with one number for each frame.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The greatest number of frames in a list. No trajectory has as many, but a few letters could request any number.
inline constexpr std::size_t kMostListedFrames = 10'000'000;

/// Parses a list of frames and returns them in the order written. The list is "all", or parts joined by commas: "7",
/// "last", "0-99", "0-99:10" (every tenth) and "90-" (to the last). Frames count from 0. A negative number counts from
/// the end, where -1 is the last frame: "-10-" are the last ten. Throws RequestError, whose text begins with `option`,
/// if the list is not understood, goes beyond frame_count or backwards, has a step of 0, has a frame twice or has more
/// than kMostListedFrames.
std::vector<std::uint64_t> parse_frame_list(const std::string& option, std::string_view text,
                                            std::uint64_t frame_count);

/// Parses one frame: "7", "last", or "-1", which is the last one, too. Throws RequestError, whose text begins with
/// `option`, if the text is not understood or the frame is beyond frame_count.
std::uint64_t parse_frame(const std::string& option, std::string_view text, std::uint64_t frame_count);

/// Returns the shortest list that parse_frame_list reads as these frames, such as "0-97" or "0-90:10,250".
std::string frame_list_text(const std::vector<std::uint64_t>& frames);

/// One column of a table of frames.
struct SeriesTable {
  std::string path, column;
  std::map<std::uint64_t, double> by_frame;  ///< finite numbers, by the number of the frame in its trajectory

  /// Returns the number of a frame. Throws InputError if the table has no row for it.
  double at(std::uint64_t frame) const;
};

/// Reads a CSV file with a header. One column has the name "frame"; `column` names that of the numbers, or is empty for
/// the first column that is neither "frame" nor "time". Throws InputError with the line if there is no such column, a
/// cell is not a number, or a frame occurs twice.
SeriesTable read_series_table(const std::string& path, const std::string& column);

}  // namespace meniscus
