// SPDX-License-Identifier: BSD-3-Clause
// The reader of Amber's prmtop, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_prmtop(std::string_view bytes) {
  static const ScratchFile file("input.prmtop");
  check_reader(kPrmtopReader, file, bytes);
}

const Registration registered_prmtop{"prmtop", run_prmtop};

}  // namespace
}  // namespace meniscus::fuzz
