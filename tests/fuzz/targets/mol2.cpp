// SPDX-License-Identifier: BSD-3-Clause
// The reader of MOL2, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.mol2");
  check_reader(kMol2Reader, file, bytes);
}

const Registration registration{"mol2", run};

}  // namespace
}  // namespace meniscus::fuzz
