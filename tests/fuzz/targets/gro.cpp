// SPDX-License-Identifier: BSD-3-Clause
// The reader of GRO, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_gro(std::string_view bytes) {
  static const ScratchFile file("input.gro");
  check_reader(kGroReader, file, bytes);
}

const Registration registered_gro{"gro", run_gro};

}  // namespace
}  // namespace meniscus::fuzz
