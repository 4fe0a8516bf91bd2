// SPDX-License-Identifier: BSD-3-Clause
// The file in state/workers/ by which a worker shows that it is running, and who it is.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/farm/inner_path.h"

namespace meniscus::farm {

constexpr double kDefaultLease = 60.0;  ///< seconds
constexpr double kShortestLease = 1.0, kLongestLease = 3600.0;

/// A name for a worker of this process that no other one has: machine, process, and chance.
std::string new_worker_name();

/// state/workers/NAME.json, relative to the bundle.
std::filesystem::path life_path(const std::string& worker);

/// What is in that file: where its worker runs, and after how many seconds it is dead if it does not touch it.
std::string life_text(double lease);

/// Now, by the clock of the file system; asked only if it must be known.
using FileClock = std::function<FileTime()>;

/// Whether that file was touched within its lease, and its process, if it is one of this machine, is there.
bool lives(const std::filesystem::path& folder, const std::string& worker, const FileClock& now);

/// The workers of a bundle that live, by name.
std::vector<std::string> live_workers(const std::filesystem::path& folder, const FileClock& now);

/// Now for those who are not workers: the time that the file system gives to a file in state/workers/ that vanishes at
/// once; where none can be made, the clock of this machine.
FileTime file_system_now(const std::filesystem::path& folder);

double seconds_between(FileTime earlier, FileTime later);

}  // namespace meniscus::farm
