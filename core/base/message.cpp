// SPDX-License-Identifier: BSD-3-Clause
// Replaces the names of options in a text by their spelling in this interface.
#include "core/base/message.h"

namespace meniscus {

std::string with_options(std::string_view text) {
  std::string spelled;
  for (std::size_t begin; (begin = text.find('@')) != std::string_view::npos;) {
    spelled += text.substr(0, begin);
    text.remove_prefix(begin + 1);
    const std::size_t end = text.find('@');
    spelled += option_name(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return spelled.append(text);
}

}  // namespace meniscus
