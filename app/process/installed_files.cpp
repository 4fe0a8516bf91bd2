// SPDX-License-Identifier: BSD-3-Clause
// Looks from the program's own place: no path of the machine that built it is kept.
#include "app/process/installed_files.h"

#include <system_error>

namespace meniscus {

namespace fs = std::filesystem;

fs::path addon_folder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  const fs::path installed = program.parent_path() / "share/meniscus/addon", built = program / "share/meniscus/addon";
  return !fs::exists(installed, none) && fs::exists(built, none) ? built : installed;
}

}  // namespace meniscus
