// SPDX-License-Identifier: BSD-3-Clause
// The reader of mmCIF, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_mmcif(std::string_view bytes) {
  static const ScratchFile file("input.cif");
  check_reader(kMmcifReader, file, bytes);
}

const Registration registered_mmcif{"mmcif", run_mmcif};

}  // namespace
}  // namespace meniscus::fuzz
