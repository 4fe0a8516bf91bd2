// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that build biological assemblies, and lists those of a file.
#include <iostream>
#include <map>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "app/molecule.h"
#include "core/base/text.h"

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
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD")
      ->needs(command.get_option("--assembly"));
}

void print_assemblies(const Structure& structure) {
  if (structure.assemblies.empty()) {
    fmt::print(std::cout, "assemblies    none described\n");
    return;
  }
  fmt::print(std::cout, "\n{:<14} {:>10}  {:<24} {}\n", "assembly", "copies", "chains", "");
  for (const Assembly& assembly : structure.assemblies) {
    for (const AssemblyPart& part : assembly.parts) {
      std::string chains = part.chains.empty() ? "all" : escaped(fmt::format("{}", fmt::join(part.chains, ",")));
      if (chains.size() > 24) chains = fmt::format("{}... ({})", chains.substr(0, 14), part.chains.size());
      fmt::print(std::cout, "{:<14} {:>10}  {:<24} {}\n", escaped(assembly.id), with_thousands(part.motions.size()),
                 chains, escaped(assembly.description));
    }
  }
}

}  // namespace meniscus
