// SPDX-License-Identifier: BSD-3-Clause
// The output of the processes that made a frame, kept beside its record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

namespace meniscus::farm {

/// Lines as they come. Of more than 64 KiB the first and the last 32 KiB are kept, with a line between that counts
/// those left out.
class FrameLog {
 public:
  void add(const std::string& line);
  /// All of it, each line with its end; the log is empty then.
  std::string take();

 private:
  std::string begin_;
  std::deque<std::string> end_;
  std::size_t end_bytes_ = 0, left_out_ = 0;
};

/// state/STEP/frame_00042.log; an empty text takes away the one that is there. Throws OutputError.
void write_frame_log(const std::filesystem::path& folder, const std::string& step, std::uint64_t frame,
                     const std::string& text);

/// That text; empty if there is none. Throws InputError: a link, or longer than any log.
std::string read_frame_log(const std::filesystem::path& folder, const std::string& step, std::uint64_t frame);

}  // namespace meniscus::farm
