// SPDX-License-Identifier: BSD-3-Clause
// Texts of files with marks to be filled in.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A file that the build has made part of the program.
struct TemplateFile {
  std::string_view path;
  std::string_view text;
};

/// The text of the file of this path, which is there.
std::string_view template_text(std::span<const TemplateFile> files, std::string_view path);

/// What stands for "@NAME@".
struct Filling {
  std::string name, text;
};

/// A template with each "@NAME@" that has a filling replaced. Texts put in are not searched again.
std::string filled(std::string_view text, const std::vector<Filling>& fillings);

}  // namespace meniscus
