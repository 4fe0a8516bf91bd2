// SPDX-License-Identifier: BSD-3-Clause
// The reader of PDBQT, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_pdbqt(std::string_view bytes) {
  static const ScratchFile file("input.pdbqt");
  check_reader(kPdbqtReader, file, bytes);
}

const Registration registered_pdbqt{"pdbqt", run_pdbqt};

}  // namespace
}  // namespace meniscus::fuzz
