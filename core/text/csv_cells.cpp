// SPDX-License-Identifier: BSD-3-Clause
// Goes through a line letter by letter, inside quotes and outside.
#include "core/text/csv_cells.h"

#include "core/text/text_lines.h"

namespace meniscus {

std::vector<std::string> csv_cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const bool twice = quoted && line[n] == '"' && n + 1 < line.size() && line[n + 1] == '"';
    if (line[n] == '"' && !twice)
      quoted = !quoted;
    else if (line[n] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[n];
    n += twice ? 1 : 0;
  }
  for (std::string& cell : cells) cell = std::string(trimmed(cell));
  return cells;
}

}  // namespace meniscus
