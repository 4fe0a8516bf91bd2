// SPDX-License-Identifier: BSD-3-Clause
// The reader of XYZ, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_xyz(std::string_view bytes) {
  static const ScratchFile file("input.xyz");
  check_reader(kXyzReader, file, bytes);
}

const Registration registered_xyz{"xyz", run_xyz};

}  // namespace
}  // namespace meniscus::fuzz
