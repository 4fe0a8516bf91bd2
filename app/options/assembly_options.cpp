// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that build biological assemblies.
#include <map>

#include "app/options/molecule_options.h"
#include "app/options/value_words.h"

namespace meniscus {

void add_assembly_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Assembly");
  command
      .add_option("--assembly", options.reading.assembly,
                  "Build this biological assembly (REMARK 350, mmCIF); list: print those of the file and stop")
      ->type_name("ID");
  const std::map<std::string, InstanceMode> words{{"exact", InstanceMode::exact}, {"separate", InstanceMode::separate}};
  command
      .add_option("--instances", options.division.instances,
                  "Compute one copy, draw it many times. exact: refused where copies come close enough for one probe "
                  "to touch two; separate: each copy has a surface of its own, as if alone")
      ->transform(one_of(words))
      ->type_name("WORD")
      ->needs(command.get_option("--assembly"));
}

}  // namespace meniscus
