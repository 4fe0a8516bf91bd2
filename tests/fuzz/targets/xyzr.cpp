// SPDX-License-Identifier: BSD-3-Clause
// The reader of XYZR, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_xyzr(std::string_view bytes) {
  static const ScratchFile file("input.xyzr");
  check_reader(kXyzrReader, file, bytes);
}

const Registration registered_xyzr{"xyzr", run_xyzr};

}  // namespace
}  // namespace meniscus::fuzz
