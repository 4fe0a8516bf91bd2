// SPDX-License-Identifier: BSD-3-Clause
// The reader of SDF, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_sdf(std::string_view bytes) {
  static const ScratchFile file("input.sdf");
  check_reader(kSdfReader, file, bytes);
}

const Registration registered_sdf{"sdf", run_sdf};

}  // namespace
}  // namespace meniscus::fuzz
