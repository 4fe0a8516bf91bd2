// SPDX-License-Identifier: BSD-3-Clause
// Scripts that let a shell complete commands, options and their words.
#pragma once

#include <string>

#include "app/options/command_tree.h"

namespace meniscus {

/// Returns a script to be sourced by bash, or put into a folder of bash-completion under the program's name.
std::string bash_completion(const CommandEntry& program);

/// Returns a script to be put into a folder of zsh's fpath as _NAME.
std::string zsh_completion(const CommandEntry& program);

/// Returns a script to be put into a folder of fish's completions as NAME.fish.
std::string fish_completion(const CommandEntry& program);

}  // namespace meniscus
