// SPDX-License-Identifier: BSD-3-Clause
// The files that a command's options name: what it reads is never replaced, and no two outputs are one file.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace meniscus {

/// Before a command begins whose options are parsed. scene: the file of --scene, which is in none of them; may be
/// empty. Throws UsageError for two outputs that are the same file.
void guard_named_files(const CLI::App& command, const std::string& scene);

}  // namespace meniscus
