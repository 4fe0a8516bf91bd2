// SPDX-License-Identifier: BSD-3-Clause
// Reads tables with one number for each frame of a trajectory.
#include "core/trajectory/series_table.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/message.h"
#include "core/base/parse_number.h"
#include "core/base/text_file.h"

namespace meniscus {

double SeriesTable::at(std::uint64_t frame) const {
  const auto found = by_frame.find(frame);
  if (found == by_frame.end())
    throw InputError(
        path, 0,
        message("has no row for frame {}; write it again for all frames of the run by @csv-series@ of meniscus surface",
                frame));
  return found->second;
}

SeriesTable read_series_table(const std::string& path, const std::string& column) {
  const TextFile file = read_text_file(path);
  LineReader lines(file.text);
  std::string_view line;
  lines.next(line);
  const std::vector<std::string> header = csv_cells_of(line);
  const auto place = [&](std::string_view name) { return std::ranges::find(header, name); };
  const auto frame = place("frame");
  if (frame == header.end())
    throw InputError(path, 1,
                     message("is not a header with a column 'frame', as @csv-series@ of meniscus surface writes it"));
  const auto value =
      column.empty()
          ? std::ranges::find_if(header, [](const std::string& name) { return name != "frame" && name != "time"; })
          : place(column);
  if (value == header.end() || value == frame) {
    std::string list;
    for (const std::string& name : header)
      if (name != "frame") list += (list.empty() ? "" : ", ") + escaped(name);
    throw InputError(path, 1, fmt::format("has no column {}; it has {}", in_quotes(column), list));
  }
  SeriesTable table{path, *value, {}};
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = csv_cells_of(line);
    std::int64_t number = 0;
    double read = 0.0;
    if (cells.size() != header.size())
      throw InputError(path, lines.number(), fmt::format("has {} cells, the header {}", cells.size(), header.size()));
    const std::string& frame_cell = cells[static_cast<std::size_t>(frame - header.begin())];
    const std::string& value_cell = cells[static_cast<std::size_t>(value - header.begin())];
    if (!parse_whole_number(frame_cell, number) || number < 0)
      throw InputError(path, lines.number(), fmt::format("frame {} is not a frame number", in_quotes(frame_cell)));
    if (!parse_number(value_cell, read))
      throw InputError(path, lines.number(),
                       fmt::format("{} {} is not a number", escaped(*value), in_quotes(value_cell)));
    if (!table.by_frame.emplace(static_cast<std::uint64_t>(number), read).second)
      throw InputError(path, lines.number(), fmt::format("frame {} appears a second time", number));
  }
  return table;
}

}  // namespace meniscus
