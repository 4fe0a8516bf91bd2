// SPDX-License-Identifier: BSD-3-Clause
// The reader of PSF, from its text to a structure.
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void run_psf(std::string_view bytes) {
  static const ScratchFile file("input.psf");
  check_reader(kPsfReader, file, bytes);
}

const Registration registered_psf{"psf", run_psf};

}  // namespace
}  // namespace meniscus::fuzz
