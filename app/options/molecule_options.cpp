// SPDX-License-Identifier: BSD-3-Clause
// Declares what several commands have alike.
#include "app/options/molecule_options.h"

namespace meniscus {

Heading::Heading(CLI::App& command, const char* text) : command_(command) { command.option_defaults()->group(text); }

Heading::~Heading() { command_.option_defaults()->group("Options"); }

void add_molecule_options(CLI::App& command, MoleculeOptions& options) {
  add_atom_options(command, options);
  add_surface_options(command, options);
  add_division_options(command, options);
  add_color_options(command, options);
}

void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what, OutputName name) {
  const Heading heading(command, "Output");
  command.add_option("-o,--output", options.path, what)->required(name == OutputName::required)->type_name("PATH");
  command.add_flag("--force", options.force, "Replace what exists at the output path");
}

}  // namespace meniscus
