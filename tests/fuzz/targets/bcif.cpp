// SPDX-License-Identifier: BSD-3-Clause
// The reader of BinaryCIF, from its bytes to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_bcif(std::string_view bytes) {
  static const ScratchFile file("input.bcif");
  check_reader(kBinaryCifReader, file, bytes);
}

const Registration registered_bcif{"bcif", run_bcif};

}  // namespace
}  // namespace meniscus::fuzz
