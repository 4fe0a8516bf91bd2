// SPDX-License-Identifier: BSD-3-Clause
// Splits a text into lines, fields and comma-separated cells.
#include "core/base/text_lines.h"

namespace meniscus {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

std::string_view take_field(std::string_view& rest) {
  const std::size_t first = rest.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    rest = {};
    return {};
  }
  rest.remove_prefix(first);
  const std::string_view field = rest.substr(0, rest.find_first_of(" \t"));
  rest.remove_prefix(field.size());
  return field;
}

std::vector<std::string_view> fields_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> fields;
  while (fields.size() < most) {
    const std::string_view field = take_field(line);
    if (field.empty()) break;
    fields.push_back(field);
  }
  return fields;
}

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
