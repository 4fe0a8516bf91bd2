// SPDX-License-Identifier: BSD-3-Clause
// Compares before it writes.
#include "core/base/shared_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/base/error.h"

namespace meniscus {

void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files) {
  const auto is_there = [&](const SharedFile& shared) {
    std::ifstream file(folder / shared.name, std::ios::binary);
    return file && std::string(std::istreambuf_iterator<char>(file), {}) == shared.text;
  };
  try {
    OutputFolder output(folder, existing);
    for (const SharedFile& shared : files)
      if (!is_there(shared)) output.file(shared.name).write(shared.text);
    output.commit();
  } catch (const OutputError&) {
    if (!std::ranges::all_of(files, is_there)) throw;  // else another process was faster
  }
}

}  // namespace meniscus
