// SPDX-License-Identifier: BSD-3-Clause
// What a picture on the GPU is made of: a computed surface with its colours, or atoms whose surface is found for each
// view.
#pragma once

#include <span>

#include "core/gpu/buffer.h"
#include "core/render/gpu_scene.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

class StageClock;
struct Coloring;

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

/// Packs the surface for each picture. Keeps buffers from surface to surface. Needs a current GL context.
class SurfaceDrawable final : public Drawable {
 public:
  /// coloring.atom has one colour per surface.atoms; both must stay until the last picture of them is made. Rays go on
  /// through points of hidden atoms; what they meet from behind is shaded like its front, and its normal still points
  /// towards the solvent.
  void show(const Surface& surface, const Coloring& coloring);

  std::span<const Ball> atoms() const override { return surface_->atoms; }
  const GpuScene& prepare(const PictureFrame& frame, StageClock& clock) override;
  const Surface* surface() const override { return surface_; }

 private:
  const Surface* surface_ = nullptr;
  const Coloring* coloring_ = nullptr;
  GpuScene scene_;
};

/// Everything of `scene` on the GPU but the colours.
void upload_scene(const RayCastScene& packed, const Surface& surface, const PictureFrame& frame, GpuScene& scene);

}  // namespace meniscus
