// SPDX-License-Identifier: BSD-3-Clause
// The program itself: its version, the folder of its files, and the command line that it was called with.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace meniscus {

/// Returns "0.1.0+g2b6bb4a4c1d2", the version and the commit; "....dirty.5f0c..." and a checksum if files differ from
/// it; "0.1.0+s77b1..." and a checksum of all sources where no repository tells. Programs with the same text are made
/// of the same sources.
const char* build_version();

/// Returns "2026-11-22", the day of the commit; without a repository, when CHANGELOG.md was last changed.
const char* build_date();

/// Returns the folder of the Blender add-on and of its driver, render_mns.py: share/meniscus/addon next to bin/, or
/// within the folder where the program was built. If neither is there, it returns the first.
std::filesystem::path addon_folder();

/// Keeps the words for command_line(). Call it once, before any other thread begins.
void remember_command_line(std::span<const char* const> words);

/// Returns the command line as a shell takes it, "meniscus 'render' '1tii.pdb' '-o' 'my picture.png'", the program
/// without its folder, control characters as \xNN. Empty if nothing was remembered.
std::string command_line();

}  // namespace meniscus
