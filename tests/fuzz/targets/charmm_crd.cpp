// SPDX-License-Identifier: BSD-3-Clause
// The reader of coordinates of CHARMM, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.crd");
  check_reader(kCharmmCrdReader, file, bytes);
}

const Registration registration{"charmm_crd", run};

}  // namespace
}  // namespace meniscus::fuzz
