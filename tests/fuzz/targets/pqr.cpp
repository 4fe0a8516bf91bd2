// SPDX-License-Identifier: BSD-3-Clause
// The reader of PQR, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_pqr(std::string_view bytes) {
  static const ScratchFile file("input.pqr");
  check_reader(kPqrReader, file, bytes);
}

const Registration registered_pqr{"pqr", run_pqr};

}  // namespace
}  // namespace meniscus::fuzz
