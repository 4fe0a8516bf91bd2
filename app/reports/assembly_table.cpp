// SPDX-License-Identifier: BSD-3-Clause
// Lays the assemblies out line by line.
#include "app/reports/assembly_table.h"

#include <iostream>
#include <string>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "core/base/text.h"

namespace meniscus {

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
