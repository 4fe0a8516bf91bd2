// SPDX-License-Identifier: BSD-3-Clause
// Puts frame numbers into file names.
#include "app/options/numbered_path.h"

#include <filesystem>

#include <fmt/format.h>

namespace meniscus {

std::optional<NumberedPath> NumberedPath::parse(const std::string& path) {
  const std::size_t last = path.rfind('#'), slash = path.rfind('/');
  if (last == std::string::npos || (slash != std::string::npos && last < slash)) return {};
  std::size_t first = last;
  while (first > 0 && path[first - 1] == '#') --first;
  NumberedPath numbered;
  numbered.before_ = path.substr(0, first);
  numbered.behind_ = path.substr(last + 1);
  numbered.digits_ = last + 1 - first;
  return numbered;
}

std::string NumberedPath::at(std::uint64_t number) const {
  return fmt::format("{}{:0{}}{}", before_, number, digits_, behind_);
}

bool NumberedPath::names(std::string_view path) const {
  if (path.size() < before_.size() + digits_ + behind_.size() || !path.starts_with(before_) || !path.ends_with(behind_))
    return false;
  const std::string_view number = path.substr(before_.size(), path.size() - before_.size() - behind_.size());
  return number.find_first_not_of("0123456789") == std::string_view::npos &&
         (number.size() == digits_ || number.front() != '0');
}

std::string numbered_name(const std::string& path) {
  const std::filesystem::path plain(path);
  const std::string ending = plain.has_extension() ? plain.extension().string() : ".png";
  return (plain.parent_path() / (plain.stem().string() + "_#####" + ending)).string();
}

}  // namespace meniscus
