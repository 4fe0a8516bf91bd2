// SPDX-License-Identifier: BSD-3-Clause
// Temporary files, which vanish with the program, whatever ends it. output_file.cpp keeps their list.
#pragma once

#include <filesystem>

namespace meniscus {

/// A temporary file at a given path. It is deleted with this object, or by remove_unfinished_outputs(). The constructor
/// makes it empty. Throws OutputError if the path exists already, or if the file cannot be made.
class ScratchFile {
 public:
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace meniscus
