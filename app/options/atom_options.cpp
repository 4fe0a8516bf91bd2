// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say which atoms of which file are taken, and with which radii.
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/options/value_words.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/formats.h"

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

/// What is taken of which file, and what is said about it.
void add_input_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Input");
  add_file_argument(command, options);
  command
      .add_option_function<std::string>(
          "--model", [&options](const std::string& text) { options.reading.model = model_choice(text); },
          "Model or frame to read: 1 (default) is the first; all: all of them as one molecule")
      ->type_name("N|all");
  command
      .add_option_function<std::string>(
          "--altloc", [&options](const std::string& text) { options.reading.altloc = altloc_choice(text); },
          "Alternate location to keep in a residue: best (default: the most occupied), first, a letter, all")
      ->check(proposes({"best", "first", "all"}))
      ->type_name("WORD");
  command
      .add_option_function<std::string>(
          "--select",
          [&options](const std::string& text) { options.reading.selection = parse_selection_option("--select", text); },
          "Take only these atoms, as in 'chain A and resid 10-50'; see meniscus help selections")
      ->type_name("EXPR");
  command
      .add_option_function<std::string>(
          "--show", [&options](const std::string& text) { options.show = parse_selection_option("--show", text); },
          "Compute the surface of all atoms taken, but draw and export only the part of these")
      ->type_name("EXPR");
  command.add_flag("--keep-water", options.reading.keep_water, "Use water molecules too");
  command.add_flag("--keep-ions", options.reading.keep_ions, "Use free ions (lone metal and halogen atoms) too");
  const std::map<std::string, UnknownElement> words{
      {"halt", UnknownElement::halt}, {"guess", UnknownElement::guess}, {"skip", UnknownElement::skip}};
  command
      .add_option("--unknown-element", options.reading.unknown_element,
                  "Atoms of unknown element: halt (default), guess (radius 2.0 Å), skip")
      ->transform(one_of(words))
      ->type_name("WORD");
  add_warning_options(command, options);
}

}  // namespace

void add_atom_options(CLI::App& command, MoleculeOptions& options) {
  add_input_options(command, options);
  add_radii_options(command, options.reading);
  add_assembly_options(command, options);
}

Selection parse_selection_option(const std::string& option, const std::string& text) {
  try {
    return parse_selection(text);
  } catch (const SelectionError& error) {
    throw SelectionError(option + ": " + error.sentence(), error.picture());
  }
}

void add_file_argument(CLI::App& command, MoleculeOptions& options) {
  command.add_option("FILE", options.file, "Molecule: " + format_names() + "; .gz too; - is standard input")
      ->required()
      ->type_name("");
}

void add_warning_options(CLI::App& command, MoleculeOptions& options) {
  const std::map<std::string, WarningDetail> words{
      {"full", WarningDetail::full}, {"summary", WarningDetail::summary}, {"none", WarningDetail::none}};
  command
      .add_option("--warnings", options.warnings,
                  "Oddities of the file: summary (default), full (a line an atom), none")
      ->transform(one_of(words))
      ->type_name("WORD");
  command.add_flag("-q,--quiet", options.quiet, "No notes on stderr; errors only");
}

}  // namespace meniscus
