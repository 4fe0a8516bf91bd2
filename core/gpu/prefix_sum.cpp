// SPDX-License-Identifier: BSD-3-Clause
// Runs the three passes of a scan kernel.
#include "core/gpu/prefix_sum.h"

#include <algorithm>
#include <string>

#include "core/gpu/context_description.h"
#include "core/gpu/kernel_parameters.h"

namespace meniscus {

void PrefixSum::operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit) {
  if (!kind_) kind_ = describe_current_context().software ? ScanKind::serial : ScanKind::parallel;
  const bool serial = kind_ == ScanKind::serial;
  const char* const path = serial ? "gpu_shaders/parallel/scan.comp" : "gpu_shaders/parallel/block_scan.comp";
  const std::uint32_t chunk_length = serial ? 512 : 1024;  // words of an invocation, or of a group of 256
  const std::uint32_t chunks = (count + chunk_length - 1) / chunk_length;
  totals_.resize(std::max(1u, chunks) * sizeof(std::uint32_t));
  for (int pass = 0; pass < 3; ++pass) {
    words.bind(0);
    totals_.bind(1);
    const Program& program = programs_.get(path, {{"PASS", std::to_string(pass)}});
    program.set(kernel::ScanParameters{.count = count, .chunk_length = chunk_length, .limit = limit});
    program.dispatch(pass == 1 ? 1 : serial ? group_count(chunks) : chunks);
  }
}

}  // namespace meniscus
