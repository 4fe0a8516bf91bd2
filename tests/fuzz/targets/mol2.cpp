// SPDX-License-Identifier: BSD-3-Clause
// The reader of MOL2, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_mol2(std::string_view bytes) {
  static const ScratchFile file("input.mol2");
  check_reader(kMol2Reader, file, bytes);
}

const Registration registered_mol2{"mol2", run_mol2};

}  // namespace
}  // namespace meniscus::fuzz
