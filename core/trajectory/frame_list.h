// SPDX-License-Identifier: BSD-3-Clause
// Lists of frames as people write them: "0-99:10,250".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// No run has as many; a list of a few letters could ask for any number.
inline constexpr std::size_t kMostListedFrames = 10'000'000;

/// The frames of "all", or of parts such as "7", "last", "0-99", "0-99:10" (every tenth) and "90-" (to the last),
/// joined by commas; in the order written. A number below 0 counts from the end, -1 is the last frame: "-10-" are the
/// last ten. Throws RequestError, its text beginning with `option`: not understood, beyond
/// frame_count (the frames count from 0), backwards, a step of 0, a frame twice, more than kMostListedFrames.
std::vector<std::uint64_t> parse_frame_list(const std::string& option, std::string_view text,
                                            std::uint64_t frame_count);

/// The frame of "7", "last" or "-1", which is the last one, too. Throws RequestError, its text beginning with `option`:
/// not understood, or not one of frame_count.
std::uint64_t parse_frame(const std::string& option, std::string_view text, std::uint64_t frame_count);

/// The shortest list of parts that parse_frame_list reads as these frames: "0-97", "0-90:10,250".
std::string frame_list_text(const std::vector<std::uint64_t>& frames);

}  // namespace meniscus
