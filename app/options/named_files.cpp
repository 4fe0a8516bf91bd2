// SPDX-License-Identifier: BSD-3-Clause
// Tells inputs from outputs by the table of properties.
#include "app/options/named_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/options/command_tree.h"
#include "app/process/program_error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

bool names_output(const std::string& option) {
  return std::ranges::any_of(properties(), [&](const Property* property) {
    return property->type == ValueType::new_file && property->long_option() == option;
  });
}

/// Of a bundle the files that it was made of, too.
void protect(const fs::path& path) {
  protect_input(path);
  std::error_code ignored;
  if (!fs::exists(path / "bundle.json", ignored)) return;
  protect_input(path / "bundle.json");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path / "inputs", ignored))
    protect_input(entry.path());
}

bool are_one_file(const std::string& a, const std::string& b) {
  std::error_code failed, ignored;
  // Absolute first: a path of which nothing is there yet stays relative.
  const auto place = [&](const std::string& path) { return fs::weakly_canonical(fs::absolute(path, failed), failed); };
  return place(a) == place(b) || fs::equivalent(a, b, ignored);
}

}  // namespace

NamedFiles::NamedFiles(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    if (option->empty() || !takes_path(*option)) continue;
    const bool writes = names_output(option->get_name());
    for (const std::string& path : option->results()) writes ? write(option->get_name(), path) : read(path);
  }
}

void NamedFiles::read(const std::string& path) { protect(path); }

void NamedFiles::write(const std::string& option, const std::string& path) {
  if (path != "-") outputs_.emplace_back(option, path);
}

void NamedFiles::check() const {
  for (std::size_t a = 0; a < outputs_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (outputs_[a].first != outputs_[b].first && are_one_file(outputs_[a].second, outputs_[b].second))
        throw UsageError(fmt::format("{} and {} name the same file, {}; choose two", outputs_[b].first,
                                     outputs_[a].first, in_quotes(outputs_[a].second)));
}

}  // namespace meniscus
