// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program, one function and one file (command_<name>.cpp, export_<name>.cpp) each.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace meniscus {

/// One row of a command table. `add` gives the empty command its description, options and callback; the callback does
/// the work and throws the errors of core/base/error.h.
struct Command {
  const char* name;
  void (*add)(CLI::App& command);
};

void add_bench(CLI::App& command);
void add_colors(CLI::App& command);
void add_completion(CLI::App& command);
void add_export(CLI::App& command);
void add_export_atoms(CLI::App& command);
void add_export_blender(CLI::App& command);
void add_export_mesh(CLI::App& command);
void add_export_mitsuba(CLI::App& command);
void add_export_pbrt(CLI::App& command);
void add_export_ply(CLI::App& command);
void add_export_povray(CLI::App& command);
void add_farm(CLI::App& command);
void add_formats(CLI::App& command);
void add_help(CLI::App& command);
void add_info(CLI::App& command);
void add_pockets(CLI::App& command);
void add_preview(CLI::App& command);
void add_render(CLI::App& command);
void add_surface(CLI::App& command);
void add_work(CLI::App& command);

/// Sets a command's one-line summary, its examples, which the help shows first, and what else a reader should know.
void describe(CLI::App& command, const std::string& summary, const std::string& examples,
              const std::string& details = "");

}  // namespace meniscus
