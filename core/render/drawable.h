// SPDX-License-Identifier: BSD-3-Clause
// Whatever a picture can be made of.
#pragma once

#include <span>

#include "core/gpu/readback.h"
#include "core/render/gpu_scene.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

class StageClock;

/// A complete surface (SurfaceDrawable), or atoms whose surface the GPU finds for each view (ViewPipeline).
class Drawable {
 public:
  virtual ~Drawable() = default;

  /// Van der Waals balls, Å; at least one. A camera's picture has its pivot among them.
  virtual std::span<const Ball> atoms() const = 0;

  /// Puts on the GPU what this picture shows, colours too; stays until the next call. Adds the time of each stage to
  /// `clock`. Throws GpuError, CapacityError, OpenSurfaceError.
  virtual const GpuScene& prepare(const PictureFrame& frame, StageClock& clock) = 0;

  /// prepare() may trust that a frame needs no more room than the one before. This asks for the counts that tell, and
  /// settle(), once they have been read back, says whether it was so. If not there is no picture, and the next
  /// prepare() trusts in nothing. Throws as prepare().
  virtual void ask(Readback&) {}
  virtual bool settle() { return true; }

  /// The surface whose patches the primitives of the scene are, if the host has it; else nullptr.
  virtual const Surface* surface() const { return nullptr; }
};

}  // namespace meniscus
