// SPDX-License-Identifier: BSD-3-Clause
// A table with one number for each frame of a trajectory, such as `meniscus surface --csv-series` writes.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace meniscus {

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
