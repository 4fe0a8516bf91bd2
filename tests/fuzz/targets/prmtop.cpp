// SPDX-License-Identifier: BSD-3-Clause
// The reader of Amber's prmtop, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.prmtop");
  check_reader(kPrmtopReader, file, bytes);
}

const Registration registration{"prmtop", run};

}  // namespace
}  // namespace meniscus::fuzz
