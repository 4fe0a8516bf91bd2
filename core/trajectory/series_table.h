// SPDX-License-Identifier: BSD-3-Clause
// One number for each frame of a trajectory, from a table such as `meniscus surface --csv-series` writes.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace meniscus {

struct SeriesTable {
  std::string path, column;
  std::map<std::uint64_t, double> by_frame;  ///< by the frame's number in its trajectory; finite

  /// Throws InputError where the table has no row of the frame.
  double at(std::uint64_t frame) const;
};

/// Reads CSV with a header, which names a column "frame" and the one of the numbers; empty: the first that is neither
/// "frame" nor "time". Throws InputError with the line: no such column, no number, a frame twice.
SeriesTable read_series_table(const std::string& path, const std::string& column);

}  // namespace meniscus
