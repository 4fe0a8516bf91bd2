// SPDX-License-Identifier: BSD-3-Clause
// Messages that name options: core writes "@NAME@", and each door spells it as its users do.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {

/// The text with each "@NAME@" and "@NAME VALUE@" as this door writes an option and its value (option_name() in
/// text.h):
/// "@frames all@" becomes "frames=all" in libraries.
std::string with_options(std::string_view text);

/// fmt::format() of such a text. Only the text itself names options, not what is put in.
template <typename... Values>
std::string message(fmt::format_string<Values...> text, Values&&... values) {
  const fmt::string_view form = text;
  return fmt::vformat(with_options({form.data(), form.size()}), fmt::make_format_args(values...));
}

}  // namespace meniscus
