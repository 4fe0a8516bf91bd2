// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of the molecule: which atoms of which file, their radii, assemblies; and those of outputs.
#include "app/options/molecule_options.h"

#include <charconv>

#include <fmt/format.h>

#include "app/options/property_options.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus {
namespace {

ModelChoice model_choice(const std::string& text) {
  ModelChoice choice;
  choice.all = text == "all";
  if (choice.all) return choice;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.number);
  if (error != std::errc() || end != text.data() + text.size() || choice.number < 1)
    throw UsageError(fmt::format("--model is {}; it must be a number from 1, or all", in_quotes(text)));
  return choice;
}

AltlocChoice altloc_choice(const std::string& text) {
  const std::optional<AltlocChoice> choice = parse_altloc_choice(text);
  if (!choice)
    throw UsageError(fmt::format("--altloc is {}; it must be best, first, all or one letter", in_quotes(text)));
  return *choice;
}

RadiusOverride radius_override_of(const std::string& text) {
  try {
    return parse_radius_override(text);
  } catch (const SelectionError& error) {
    throw SelectionError("--radius: " + error.sentence(), error.picture());
  }
}

void add_radii_options(CLI::App& command, ReadOptions& reading) {
  PropertyOptions options(command);
  options.add_word("molecule.hydrogens", reading.hydrogens, {Hydrogens::keep, Hydrogens::drop, Hydrogens::automatic});
  std::vector<std::string> sets{"file"};
  for (const RadiiSet* set : radii_sets()) sets.emplace_back(set->name);
  options.add("molecule.radii", reading.radii.set)->check(one_of(sets));
  options.add("molecule.radii_file", reading.radii.files)->type_size(1)->expected(1, 100);
  options.add_list("molecule.radius", [&reading](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) reading.radii.overrides.push_back(radius_override_of(text));
  });
}

void add_assembly_options(CLI::App& command, MoleculeOptions& molecule) {
  PropertyOptions options(command);
  CLI::Option* const assembly = options.add("molecule.assembly", molecule.reading.assembly);
  options.add_word("molecule.instances", molecule.division.instances, {InstanceMode::exact, InstanceMode::separate})
      ->needs(assembly);
}

}  // namespace

void add_file_argument(CLI::App& command, MoleculeOptions& molecule) {
  PropertyOptions(command)
      .add("molecule.file", molecule.file)
      ->description("Molecule: " + format_names() + "; .gz too; - is standard input")
      ->required();
}

void add_warning_options(CLI::App& command, MoleculeOptions& molecule) {
  PropertyOptions options(command);
  options.add_word("molecule.warnings", molecule.warnings,
                   {WarningDetail::full, WarningDetail::summary, WarningDetail::none});
  options.add("molecule.quiet", molecule.quiet);
}

void add_atom_options(CLI::App& command, MoleculeOptions& molecule) {
  ReadOptions& reading = molecule.reading;
  PropertyOptions options(command);
  add_file_argument(command, molecule);
  options.add_parsed("molecule.model", [&reading](const std::string& text) { reading.model = model_choice(text); });
  options.add_parsed("molecule.altloc", [&reading](const std::string& text) { reading.altloc = altloc_choice(text); });
  options.add_selection("molecule.select", reading.selection);
  options.add_selection("surface.show", molecule.show);
  options.add("molecule.keep_water", reading.keep_water);
  options.add("molecule.keep_ions", reading.keep_ions);
  options.add_word("molecule.unknown_element", reading.unknown_element,
                   {UnknownElement::halt, UnknownElement::guess, UnknownElement::skip});
  add_warning_options(command, molecule);
  add_radii_options(command, reading);
  add_assembly_options(command, molecule);
}

void add_molecule_options(CLI::App& command, MoleculeOptions& molecule) {
  add_atom_options(command, molecule);
  add_surface_options(command, molecule);
  add_division_options(command, molecule);
  add_color_options(command, molecule);
}

void add_output_options(CLI::App& command, OutputOptions& output, const std::string& what, OutputName name) {
  PropertyOptions options(command);
  options.add("output.file", output.path)->description(what)->required(name == OutputName::required);
  options.add("output.force", output.force);
}

}  // namespace meniscus
