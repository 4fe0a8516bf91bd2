// SPDX-License-Identifier: BSD-3-Clause
// One set of files for each folder.
#include "app/msms/write_files.h"

#include <filesystem>
#include <system_error>

#include "core/base/error.h"

namespace meniscus::msms {

void OutputFiles::begin(const std::string& path) {
  if (files_.contains(path)) return;
  namespace fs = std::filesystem;
  const fs::path target(path), parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code none;
  if (!fs::is_directory(parent, none)) throw OutputError(path, "its folder does not exist; make it first");
  std::unique_ptr<OutputFolder>& folder = folders_[parent.string()];
  if (!folder) folder = std::make_unique<OutputFolder>(parent, Existing::replace);
  files_[path] = &folder->file(target.filename().string());
}

void OutputFiles::write(const std::string& path, const std::string& text) {
  begin(path);
  files_.at(path)->write(text);
}

void OutputFiles::commit() {
  for (auto& [name, folder] : folders_) folder->commit();
}

}  // namespace meniscus::msms
