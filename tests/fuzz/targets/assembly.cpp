// SPDX-License-Identifier: BSD-3-Clause
// Assemblies: operator expressions, the records of PDB and mmCIF, and the molecules built from them.
#include <cmath>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/structure/assembly.h"
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void check_expression(std::string_view text) {
  try {
    std::size_t products = 1;
    for (const std::vector<std::string>& list : operator_factors(text, "expression")) {
      products *= list.size();
      require(products >= 1 && products <= kMostOperators, "there are products, and not too many");
    }
  } catch (const InputError& error) {
    require_clear(error);
  }
}

void check_built(const Assembly& assembly, CopyMode mode) {
  Structure structure;
  structure.atoms = sample_atoms();
  structure.report.read = structure.report.used = structure.atoms.size();
  try {
    assemble(structure, assembly, mode);
    for (const Atom& atom : structure.atoms) {
      for (int axis = 0; axis < 3; ++axis)
        require(std::abs(atom.position[axis]) <= kLargestCoordinate, "atoms of assemblies stand within bounds");
    }
    std::size_t placed = 0;
    for (const Instances& group : structure.instances) {
      require(!group.motions.empty(), "instances stand somewhere");
      placed += group.atoms.size();
    }
    require(mode == CopyMode::atoms || placed == structure.atoms.size(), "each atom belongs to one group of instances");
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

void check_file(std::string_view bytes, std::vector<Assembly> (*read)(const TextFile&)) {
  try {
    for (const Assembly& assembly : read({"input", std::string(bytes)})) {
      std::size_t motions = 0;
      for (const AssemblyPart& part : assembly.parts) motions += part.motions.size();
      if (motions > 1000) continue;
      check_built(assembly, CopyMode::atoms);
      check_built(assembly, CopyMode::instances);
    }
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

void run_assembly(std::string_view bytes) {
  if (bytes.find('\0') != std::string_view::npos) return;  // A text that was read never has it.
  check_expression(bytes);
  check_file(bytes, read_pdb_assemblies);
  check_file(bytes, read_mmcif_assemblies);
}

const Registration registered_assembly{"assembly", run_assembly};

}  // namespace
}  // namespace meniscus::fuzz
