// SPDX-License-Identifier: BSD-3-Clause
// From the device a user asked for to what makes pictures there.
#pragma once

#include <memory>
#include <optional>

#include "core/gpu/egl_context.h"
#include "core/render/surface_renderer.h"
#include "core/scene/surface_request.h"

namespace meniscus {

/// Makes pictures of computed surfaces: on the CPU if that was asked for, else on GL, in a context of its own.
class PictureDevice {
 public:
  /// Throws GpuError.
  explicit PictureDevice(const SurfaceRequest& request);

  SurfaceRenderer& renderer() { return *renderer_; }
  /// Current on this thread; nullptr where the CPU makes the pictures.
  const EglContext* context() const { return context_ ? &*context_ : nullptr; }

 private:
  std::optional<EglContext> context_;
  std::unique_ptr<SurfaceRenderer> renderer_;
};

}  // namespace meniscus
