// SPDX-License-Identifier: BSD-3-Clause
// Describes a GL context: its renderer and version, and the limits that decide whether a job fits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace meniscus {

/// Names for people, and a flag for software rendering.
struct ContextDescription {
  std::string vendor, renderer, version;
  bool software = false;
};

/// True if a renderer of this name (GL_RENDERER) draws on the CPU: llvmpipe, softpipe, SwiftShader, zink on lavapipe...
bool is_software_renderer(std::string renderer);

/// Describes the context that is current on this thread; there must be one.
ContextDescription describe_current_context();

/// Throws GpuError if the driver has reset the context current on this thread: its contents are lost.
void require_living_context();

struct GpuLimits {
  std::size_t storage_block_bytes = 0;  ///< largest buffer a kernel can see
  std::uint32_t group_count = 0;        ///< largest group count along x and along y
  std::uint32_t storage_blocks = 0;     ///< storage buffers per compute kernel
  std::uint32_t shared_bytes = 0;       ///< shared memory per group
  std::uint32_t group_size = 0;         ///< invocations per group
};

/// Queries the limits of the driver; a context must be current.
GpuLimits query_gpu_limits();

/// Throws GpuError naming `what` if GL has an error pending, CapacityError if it is out of memory.
void check_gl(const char* what);

}  // namespace meniscus
