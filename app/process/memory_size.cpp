// SPDX-License-Identifier: BSD-3-Clause
// Asks the system and its control groups.
#include "app/process/memory_size.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace meniscus {
namespace {

/// The number in a file of a control group; unlimited if there is no such file, or "max" in it.
std::uint64_t read_limit(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t bytes = 0;
  return in >> bytes ? bytes : UINT64_MAX;
}

/// The smallest limit of a group and of those it lies in.
std::uint64_t limit_of_group(const std::filesystem::path& root, std::filesystem::path group, const char* file) {
  std::uint64_t limit = UINT64_MAX;
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    limit = std::min(limit, read_limit(root / group / file));
  return std::min(limit, read_limit(root / file));
}

}  // namespace

std::uint64_t memory_limit(std::istream& groups, const std::filesystem::path& mounted) {
  std::uint64_t limit = UINT64_MAX;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    // Version 2 has one tree, which names no controllers; version 1 has one for each.
    if (controllers.empty()) limit = std::min(limit, limit_of_group(mounted, group, "memory.max"));
    if (controllers == "memory")
      limit = std::min(limit, limit_of_group(mounted / "memory", group, "memory.limit_in_bytes"));
  }
  return limit;
}

std::uint64_t memory_size() {
  const std::uint64_t physical =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::ifstream groups("/proc/self/cgroup");
  return std::min(physical, memory_limit(groups, "/sys/fs/cgroup"));
}

}  // namespace meniscus
