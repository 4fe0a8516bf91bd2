// SPDX-License-Identifier: BSD-3-Clause
// Knows the names of unfinished files that workers leave.
#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/makers.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

template <typename Condition>
void remove_from(const fs::path& folder, const Condition& unwanted) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (unwanted(entry.path().filename().string())) found.push_back(entry.path());
  for (const fs::path& path : found) fs::remove_all(path, error);
}

}  // namespace

void remove_own_leftovers(const fs::path& folder) {
  const std::string pictures = fmt::format(".povray_{}_", ::getpid()), driver = fmt::format(".blender_{}", ::getpid());
  remove_from(folder / "images", [&](const std::string& name) { return name.starts_with(pictures); });
  remove_from(folder, [&](const std::string& name) { return name == driver; });
}

void remove_leftovers(const fs::path& folder) {
  const auto unfinished = [](const std::string& name) {
    return name.starts_with(".povray_") || name.starts_with(".blender_") ||
           (name.starts_with('.') && name.find(".part") != std::string::npos);
  };
  for (const char* place : {".", "images", "scene", "state/surface", "state/render"})
    remove_from(folder / place, unfinished);
  for (const char* step : {"state/surface", "state/render"})
    remove_from(folder / step, [](const std::string& name) { return name.find(".claim") != std::string::npos; });
  remove_from(folder / "state", [](const std::string& name) { return name == "workers"; });
}

}  // namespace meniscus::farm
