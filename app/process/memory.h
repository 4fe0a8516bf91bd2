// SPDX-License-Identifier: BSD-3-Clause
// The memory of this process: how much it may use, and what happens when it runs out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

namespace meniscus {

/// Returns the memory of the machine in bytes, or less where a control group of a batch system or container allows
/// less.
std::uint64_t memory_size();

/// Returns the smallest limit, in bytes, of control groups and of the groups around them; UINT64_MAX if there is no
/// limit. Lines of /proc/PID/cgroup name the groups (NUMBER:CONTROLLERS:/GROUP, cgroups(7)), which are mounted below
/// the given folder.
std::uint64_t memory_limit(std::istream& groups, const std::filesystem::path& mounted);

/// Says that all libraries are loaded. Libraries do not survive a limit of memory or threads: some crash while they are
/// loaded, others wait for ever for a thread that could not be started. Under such a limit, and only then, either ends
/// in a line on standard error and exit code 5; the wait is watched until this call at the beginning of main().
void libraries_are_loaded();

/// True if there is such a limit.
bool memory_is_limited();

/// From this call on, a `new` that gets no memory is remembered; it throws std::bad_alloc as ever. Call it at the
/// beginning of main().
void remember_failed_allocations();

/// True if a `new` got no memory since then. Requests of C libraries are not counted.
bool memory_ran_out() noexcept;

/// After this call freed memory stays with the process, and tables of less than 32 MiB are taken from it. Larger tables
/// go back to the system at once, so that the memory at the peak grows by a few per cent only. New memory costs a page
/// fault for each 4 KiB, a tenth of the time of a small surface. The call has no effect with C libraries that lack such
/// a setting.
void keep_freed_memory();

}  // namespace meniscus
