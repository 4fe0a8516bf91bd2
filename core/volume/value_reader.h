// SPDX-License-Identifier: BSD-3-Clause
// The values of text formats, field by field over lines.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/text/parse_number.h"
#include "core/text/text_file.h"
#include "core/text/text_lines.h"

namespace meniscus {

/// The next `count` numbers of a file, of any number a line. Throws InputError.
inline std::vector<float> read_values(const TextFile& file, LineReader& lines, std::size_t count) {
  // Each value takes two bytes at least, so no count makes this reserve more than the file is worth.
  if (count > lines.bytes_left() / 2 + 1)
    throw InputError(
        file.path, lines.number(),
        fmt::format("promises {} values, more than the {} bytes behind it can hold; is the file cut short?",
                    with_thousands(count), with_thousands(lines.bytes_left())));
  std::vector<float> values;
  values.reserve(count);
  std::string_view line;
  while (values.size() < count && lines.next(line)) {
    for (std::string_view field = take_field(line); !field.empty(); field = take_field(line)) {
      double value = 0.0;
      if (values.size() == count || !parse_number(field, value) || !std::isfinite(static_cast<float>(value)))
        throw InputError(
            file.path, lines.number(),
            values.size() == count
                ? fmt::format("holds more than the {} values that its header promises", with_thousands(count))
                : fmt::format("{} stands where value {} of {} should; values are finite numbers", in_quotes(field),
                              with_thousands(values.size() + 1), with_thousands(count)));
      values.push_back(static_cast<float>(value));
    }
  }
  if (values.size() < count)
    throw InputError(file.path, lines.number(),
                     fmt::format("ends after {} of {} values; is the file cut short?", with_thousands(values.size()),
                                 with_thousands(count)));
  return values;
}

}  // namespace meniscus
