// SPDX-License-Identifier: BSD-3-Clause
// File names with a place for the number of a frame: "film/frame_#####.png".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

class NumberedPath {
 public:
  /// The last run of # in the file's name stands for the number. Nothing if there is none.
  static std::optional<NumberedPath> parse(const std::string& path);

  /// With zeros before the number, at least as many digits as there are #.
  std::string at(std::uint64_t number) const;
  /// Whether at() gives this path for some number.
  bool names(std::string_view path) const;

 private:
  std::string before_, behind_;
  std::size_t digits_ = 0;
};

/// The path with "_#####" before its ending, to be proposed.
std::string numbered_name(const std::string& path);

}  // namespace meniscus
