// SPDX-License-Identifier: BSD-3-Clause
// Messages that name options. Core writes "@NAME@", and each interface (command line, library) spells it in its own
// way.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {

/// Returns the text with each "@NAME@" and "@NAME VALUE@" spelled as this interface writes an option and its value
/// (option_name() in text.h). For example "@frames all@" becomes "frames=all" in libraries.
std::string with_options(std::string_view text);

/// Formats such a text by fmt::format(). Options are replaced in the text only, not in the values.
template <typename... Values>
std::string message(fmt::format_string<Values...> text, Values&&... values) {
  const fmt::string_view form = text;
  return fmt::vformat(with_options({form.data(), form.size()}), fmt::make_format_args(values...));
}

}  // namespace meniscus
