// SPDX-License-Identifier: BSD-3-Clause
// Makes the renderer for the device that a user chose.
#pragma once

#include <memory>
#include <optional>

#include "core/gpu/egl_context.h"
#include "core/scene/renderers.h"
#include "core/scene/surface_computer.h"

namespace meniscus {

/// The device of pictures of computed surfaces: the CPU, or GL in a context of its own.
class PictureDevice {
 public:
  /// The automatic choice is a hardware GPU if there is one, else the CPU, which is faster than software GL. Throws
  /// GpuError if the user chose GL and it is not available.
  explicit PictureDevice(const SurfaceRequest& request);

  StillRenderer& renderer() { return *renderer_; }
  /// Returns the context, which is current on this thread; nullptr if pictures are made on the CPU.
  const EglContext* context() const { return context_ ? &*context_ : nullptr; }

 private:
  void find_gl(DeviceChoice choice);

  ThreadLimit thread_limit_;
  std::optional<EglContext> context_;
  std::unique_ptr<StillRenderer> renderer_;
};

}  // namespace meniscus
