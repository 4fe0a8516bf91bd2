// SPDX-License-Identifier: BSD-3-Clause
// Gives libFuzzer the one target that is linked into its program.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meniscus::fuzz::targets().front().run({reinterpret_cast<const char*>(data), size});
  return 0;
}
