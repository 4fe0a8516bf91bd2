// SPDX-License-Identifier: BSD-3-Clause
// The reader of PQR, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run(std::string_view bytes) {
  static const ScratchFile file("input.pqr");
  check_reader(kPqrReader, file, bytes);
}

const Registration registration{"pqr", run};

}  // namespace
}  // namespace meniscus::fuzz
