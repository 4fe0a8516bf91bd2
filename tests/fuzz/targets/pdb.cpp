// SPDX-License-Identifier: BSD-3-Clause
// The reader of PDB, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_pdb(std::string_view bytes) {
  static const ScratchFile file("input.pdb");
  check_reader(kPdbReader, file, bytes);
}

const Registration registered_pdb{"pdb", run_pdb};

}  // namespace
}  // namespace meniscus::fuzz
