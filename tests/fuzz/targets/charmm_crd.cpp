// SPDX-License-Identifier: BSD-3-Clause
// The reader of coordinates of CHARMM, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_charmm_crd(std::string_view bytes) {
  static const ScratchFile file("input.crd");
  check_reader(kCharmmCrdReader, file, bytes);
}

const Registration registered_charmm_crd{"charmm_crd", run_charmm_crd};

}  // namespace
}  // namespace meniscus::fuzz
