// SPDX-License-Identifier: BSD-3-Clause
// Files that vanish with the program, whatever ends it; output_file.cpp keeps the list.
#pragma once

#include <filesystem>

namespace meniscus {

/// A new file of exactly this path that is deleted with this object, or by remove_unfinished_outputs().
/// Others write it. Throws OutputError if there is a file of this path already, or none can be made.
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
