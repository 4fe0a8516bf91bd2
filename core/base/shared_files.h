// SPDX-License-Identifier: BSD-3-Clause
// Files that several processes, each with a chunk of one run, write with the same bytes.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/base/output_file.h"

namespace meniscus {

struct SharedFile {
  std::string name;  ///< plain, in the folder
  std::string text;
};

/// Files that are there with just this text stay; the others are written, all or none. Throws OutputError, with
/// Existing::refuse also for a file of another text.
void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files);

}  // namespace meniscus
