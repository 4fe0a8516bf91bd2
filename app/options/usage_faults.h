// SPDX-License-Identifier: BSD-3-Clause
// Messages about options that were not understood.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace meniscus {

/// From now on the last of an option that may be given once counts, in this command and those added to it later.
void let_the_last_count(CLI::App& program);

/// The command whose options were being read when parsing ended: the innermost of those that were named.
const CLI::App& named_command(const CLI::App& program);

/// "meniscus render", for that of a program.
std::string command_path(const CLI::App& command);

/// The sentence for words that the named command does not know: the first of them in the order they were typed, and the
/// option that was meant, by its letters or by what other programs call it.
std::string unknown_option_fault(const CLI::App& program, std::span<const char* const> words);

/// "; did you mean X?" for the option of the command that a word may mean; else empty.
std::string meant_option(const CLI::App& command, std::string_view word);

}  // namespace meniscus
