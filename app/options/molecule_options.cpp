// SPDX-License-Identifier: BSD-3-Clause
// What all commands do alike with their options.
#include "app/options/molecule_options.h"

#include <iostream>
#include <memory>

#include <unistd.h>

#include "core/base/text.h"

namespace meniscus {

Heading::Heading(CLI::App& command, const char* text) : command_(command) { command.option_defaults()->group(text); }

Heading::~Heading() { command_.option_defaults()->group("Options"); }

void add_molecule_options(CLI::App& command, MoleculeOptions& options) {
  add_atom_options(command, options);
  add_surface_options(command, options);
  add_division_options(command, options);
  add_color_options(command, options);
}

void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what) {
  const Heading heading(command, "Output");
  command.add_option("-o,--output", options.path, what)->required()->type_name("PATH");
  command.add_flag("--force", options.force, "Replace what exists at the output path");
}

void say(const MoleculeOptions& options, const std::string& line) {
  if (!options.quiet) std::cerr << "meniscus: " << escaped(line) << std::endl;
}

void say_warnings(const MoleculeOptions& options, const Structure& structure) {
  if (options.warnings == WarningDetail::none) return;
  for (const Warning& warning : structure.report.warnings) {
    say(options, "warning: " + structure.file + ": " + warning.text);
    if (options.warnings != WarningDetail::full) continue;
    for (const std::string& detail : warning.details) say(options, "  " + detail);
  }
}

ProgressSink progress_on_stderr(const MoleculeOptions& options) {
  if (options.quiet) return {};
  auto text = std::make_shared<ProgressText>(::isatty(STDERR_FILENO) == 1,
                                             [](std::string_view part) { std::cerr << part << std::flush; });
  return [text](const ProgressReport& report) { text->report(report); };
}

}  // namespace meniscus
