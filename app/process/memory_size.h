// SPDX-License-Identifier: BSD-3-Clause
// How much memory this process may use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

namespace meniscus {

/// Bytes: what the machine has, or less where a control group, as batch systems and containers set them, allows less.
std::uint64_t memory_size();

/// The smallest limit of the control groups that lines of /proc/PID/cgroup name (NUMBER:CONTROLLERS:/GROUP, cgroups(7))
/// and of those that these lie in, below the folder that groups are mounted in; UINT64_MAX without one.
std::uint64_t memory_limit(std::istream& groups, const std::filesystem::path& mounted);

}  // namespace meniscus
