// SPDX-License-Identifier: BSD-3-Clause
// Reads limits of the system and its control groups, and remembers when memory was short.
#include "app/process/program_main.h"

#include <algorithm>
#include <atomic>
#include <climits>
#include <cstdlib>
#include <fstream>
#include <new>

#include "app/process/system_process.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace meniscus {
namespace {

/// Returns the number in a file of a control group; unlimited if there is no such file, or if it contains "max".
std::uint64_t read_limit(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t bytes = 0;
  return in >> bytes ? bytes : UINT64_MAX;
}

/// Returns the smallest limit of a group and of the groups around it.
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
    // Version 2 has one tree, which names no controllers; version 1 has one tree for each controller.
    if (controllers.empty()) limit = std::min(limit, limit_of_group(mounted, group, "memory.max"));
    if (controllers == "memory")
      limit = std::min(limit, limit_of_group(mounted / "memory", group, "memory.limit_in_bytes"));
  }
  return limit;
}

std::uint64_t memory_size() {
  std::ifstream groups("/proc/self/cgroup");
  return std::min(system_process::physical_memory(), memory_limit(groups, "/sys/fs/cgroup"));
}

void libraries_are_loaded() { system_process::libraries_are_loaded(); }

bool memory_is_limited() { return system_process::memory_is_limited(); }

namespace {

std::atomic<bool> failed{false};

[[noreturn]] void remember() {
  failed = true;
  throw std::bad_alloc();
}

}  // namespace

void remember_failed_allocations() { std::set_new_handler(remember); }

bool memory_ran_out() noexcept { return failed; }

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kOwnMapping = 32 << 20;  // bytes, the most that malloc takes
  ::mallopt(M_MMAP_THRESHOLD, kOwnMapping);
  ::mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
}

}  // namespace meniscus
