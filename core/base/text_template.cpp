// SPDX-License-Identifier: BSD-3-Clause
// Finds templates by path and marks by name.
#include "core/base/text_template.h"

#include <algorithm>
#include <cassert>

namespace meniscus {

std::string_view template_text(std::span<const TemplateFile> files, std::string_view path) {
  const auto found = std::ranges::find(files, path, &TemplateFile::path);
  assert(found != files.end());
  return found->text;
}

std::string filled(std::string_view text, const std::vector<Filling>& fillings) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result.append(text.substr(0, begin));
    if (begin == std::string_view::npos) return result;
    text.remove_prefix(begin);
    const auto filling =
        std::ranges::find_if(fillings, [&](const Filling& f) { return text.starts_with("@" + f.name + "@"); });
    const bool is_mark = filling != fillings.end();
    result.append(is_mark ? filling->text : "@");
    text.remove_prefix(is_mark ? filling->name.size() + 2 : 1);
  }
}

}  // namespace meniscus
