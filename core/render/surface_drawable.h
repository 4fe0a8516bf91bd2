// SPDX-License-Identifier: BSD-3-Clause
// A computed surface with its colours, to be drawn.
#pragma once

#include <span>

#include "core/render/drawable.h"

namespace meniscus {

struct Coloring;

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
