// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say which atoms of which file are taken, and with which radii.
#include <map>

#include "app/molecule_options.h"

namespace meniscus {

void add_atom_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Input");
  command.add_option("FILE", options.file, "Molecule: PDB, mmCIF (.gz too) or XYZR; told apart by content")
      ->required()
      ->type_name("");
  command.add_flag("--keep-water", options.reading.keep_water, "Use water molecules too");
  command.add_flag("--keep-ions", options.reading.keep_ions, "Use free ions (lone metal and halogen atoms) too");
  const std::map<std::string, UnknownElement> words{
      {"halt", UnknownElement::halt}, {"guess", UnknownElement::guess}, {"skip", UnknownElement::skip}};
  command
      .add_option("--unknown-element", options.reading.unknown_element,
                  "Atoms of unknown element: halt (default), guess (radius 2.0 Å), skip")
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD");
  command.add_flag("-q,--quiet", options.quiet, "No notes on stderr; errors only");
}

}  // namespace meniscus
