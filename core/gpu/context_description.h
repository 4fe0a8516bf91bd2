// SPDX-License-Identifier: BSD-3-Clause
// What a GL context says about itself, whoever made it.
#pragma once

#include <string>

namespace meniscus {

/// Names for people, and whether the CPU draws.
struct ContextDescription {
  std::string vendor, renderer, version;
  bool software = false;
};

/// Whether a renderer of this name (GL_RENDERER) draws on the CPU: llvmpipe, softpipe, SwiftShader, zink on lavapipe...
bool is_software_renderer(std::string renderer);

/// Of the context current on this thread; there must be one.
ContextDescription describe_current_context();

/// Throws GpuError if the driver has reset the context current on this thread: all it held is lost.
void require_living_context();

}  // namespace meniscus
