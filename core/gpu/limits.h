// SPDX-License-Identifier: BSD-3-Clause
// The driver's limits that decide whether and how a job fits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meniscus {

struct GpuLimits {
  std::size_t storage_block_bytes = 0;  ///< largest buffer a kernel can see
  std::uint32_t group_count = 0;        ///< largest group count along x and along y
  std::uint32_t storage_blocks = 0;     ///< storage buffers per compute kernel
  std::uint32_t shared_bytes = 0;       ///< shared memory per group
  std::uint32_t group_size = 0;         ///< invocations per group
};

/// Asks the driver; needs a current context.
GpuLimits query_gpu_limits();

/// Throws GpuError naming `what` if GL has an error pending, CapacityError if it is out of memory.
void check_gl(const char* what);

}  // namespace meniscus
