// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program, one function each.
#pragma once

#include <span>
#include <string>

#include <CLI/CLI.hpp>

namespace meniscus {

/// One row of a table of commands. `add` gives the empty command its options and its callback, which does the work and
/// throws the errors of core/base/error.h.
struct Command {
  const char* name;
  const char* summary;  ///< one line
  void (*add)(CLI::App& command);
  const char* heading_below = "";
  std::span<const Command> (*below)() = nullptr;
};

/// A row of `meniscus export`. It registers itself in the table, so that a new format touches no other file.
struct ExportCommand {
  ExportCommand(const char* name, const char* summary, void (*add)(CLI::App& command));
};

/// Returns the rows of `meniscus export`, by name.
std::span<const Command> exporters();

/// Returns the commands of the program.
std::span<const Command> commands();

/// The time when commands declare their options: all at once, for help and completion, or each when it is reached.
enum class Declared { at_once, when_reached };

/// Adds the commands and their subcommands; the rows must outlive `parent`.
void add_commands(CLI::App& parent, const std::string& heading, std::span<const Command> rows, Declared when);

void add_bench(CLI::App& command);
void add_colors(CLI::App& command);
void add_completion(CLI::App& command);
void add_farm(CLI::App& command);
void add_farm_bundle(CLI::App& command);
void add_farm_verify(CLI::App& command);
void add_film(CLI::App& command);
void add_formats(CLI::App& command);
void add_help(CLI::App& command);
void add_info(CLI::App& command);
void add_looks(CLI::App& command);
void add_morph(CLI::App& command);
void add_panels(CLI::App& command);
void add_pockets(CLI::App& command);
void add_preview(CLI::App& command);
void add_render(CLI::App& command);
void add_surface(CLI::App& command);
void add_work(CLI::App& command);

/// Sets a command's examples, which its help shows first, and further details.
void describe(CLI::App& command, const std::string& examples, const std::string& details = "");

}  // namespace meniscus
