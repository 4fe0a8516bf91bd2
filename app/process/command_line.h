// SPDX-License-Identifier: BSD-3-Clause
// The command line of this process, for files that say how they were made.
#pragma once

#include <span>
#include <string>

namespace meniscus {

/// Call once, before any other thread begins.
void remember_command_line(std::span<const char* const> words);

/// "meniscus 'render' '1tii.pdb' '-o' 'my picture.png'": as a shell takes it, the program without its folder, control
/// characters as \xNN. Empty if nothing was remembered.
std::string command_line();

}  // namespace meniscus
