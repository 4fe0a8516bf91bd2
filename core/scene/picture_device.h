// SPDX-License-Identifier: BSD-3-Clause
// Makes the renderer for the device that a user asked for.
#pragma once

#include <memory>
#include <optional>

#include "core/gpu/egl_context.h"
#include "core/scene/renderers.h"
#include "core/scene/surface_computer.h"

namespace meniscus {

/// Makes pictures of computed surfaces: on the CPU or, in a context of its own, on GL.
class PictureDevice {
 public:
  /// Automatic takes a hardware GPU if there is one, else the CPU, which is faster than software GL. Throws GpuError
  /// where GL is asked for by name.
  explicit PictureDevice(const SurfaceRequest& request);

  StillRenderer& renderer() { return *renderer_; }
  /// Current on this thread; nullptr where the CPU makes the pictures.
  const EglContext* context() const { return context_ ? &*context_ : nullptr; }

 private:
  void find_gl(DeviceChoice choice);

  ThreadLimit thread_limit_;
  std::optional<EglContext> context_;
  std::unique_ptr<StillRenderer> renderer_;
};

}  // namespace meniscus
