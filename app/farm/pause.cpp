// SPDX-License-Identifier: BSD-3-Clause
// Makes and removes the file that pauses a bundle.
#include "app/farm/pause.h"

#include <fmt/format.h>

#include "app/farm/inner_path.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPaused = "state/paused";

}  // namespace

bool is_paused(const fs::path& folder) { return inner_entry(folder, kPaused) == Entry::file; }

void set_paused(const fs::path& folder, bool paused) {
  const fs::path path = folder / kPaused;
  if (is_paused(folder) == paused) return;
  if (!paused) {
    std::error_code error;
    fs::remove(path, error);
    if (error) throw OutputError(path.string(), fmt::format("cannot be removed: {}", error.message()));
    return;
  }
  make_folders_of(path);
  OutputFile file(path, Existing::replace);
  file.write("meniscus farm resume removes this file\n");
  file.commit();
}

}  // namespace meniscus::farm
