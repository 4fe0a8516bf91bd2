// SPDX-License-Identifier: BSD-3-Clause
// Runs the three passes of the scan kernel.
#include "core/gpu/prefix_sum.h"

#include <algorithm>
#include <string>

#include "core/gpu/kernel_parameters.h"

namespace meniscus {

void PrefixSum::operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit) {
  constexpr std::uint32_t kChunkLength = 512;  // words per invocation
  const std::uint32_t chunks = (count + kChunkLength - 1) / kChunkLength;
  totals_.resize(std::max(1u, chunks) * sizeof(std::uint32_t));
  for (int pass = 0; pass < 3; ++pass) {
    words.bind(0);
    totals_.bind(1);
    const Program& program = programs_.get("gpu_shaders/parallel/scan.comp", {{"PASS", std::to_string(pass)}});
    program.set(kernel::ScanParameters{.count = count, .chunk_length = kChunkLength, .limit = limit});
    program.dispatch(pass == 1 ? 1 : group_count(chunks));
  }
}

}  // namespace meniscus
