// SPDX-License-Identifier: BSD-3-Clause
// The memory of this process: how much it may use, and what happens when it runs out.
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

/// Libraries do not survive that they get no memory or thread: they crash, some while they are loaded, others wait for
/// ever for a thread that could not be started. Under such a limit, and only then, this is a line on standard error and
/// exit code 5, from before their initialisation on. Call at the beginning of main(): nothing waits any more.
void libraries_are_loaded();

/// Is there such a limit?
bool memory_is_limited();

/// Call at the beginning of main(): from then on `new` that gets no memory is remembered, and throws std::bad_alloc as
/// ever.
void remember_failed_allocations();

/// Has `new` got no memory since? What C libraries ask for is not counted.
bool memory_ran_out() noexcept;

/// From here on tables of less than 32 MiB are taken from memory that was freed before, which stays with the process;
/// larger ones go back to the system at once, so that what the process uses at its peak grows by a few per cent only.
/// New memory costs a page fault for each 4 KiB, a tenth of a small surface. Without effect on C libraries that know no
/// such setting.
void keep_freed_memory();

}  // namespace meniscus
