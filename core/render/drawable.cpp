// SPDX-License-Identifier: BSD-3-Clause
// Puts a computed surface with its colours on the GPU.
#include "core/render/drawable.h"

#include <cassert>
#include <cstdint>
#include <vector>

#include "core/color/coloring.h"
#include "core/gpu/program.h"

namespace meniscus {

void SurfaceDrawable::show(const Surface& surface, const Coloring& coloring) {
  assert(coloring.atom.size() == surface.atoms.size());
  surface_ = &surface;
  coloring_ = &coloring;
}

const GpuScene& SurfaceDrawable::prepare(const PictureFrame& frame, StageClock& clock) {
  const GpuStage stage(clock, "pack");
  upload_scene(pack_scene(*surface_, *coloring_, frame), *surface_, frame, scene_);
  upload_coloring(*coloring_, scene_);
  return scene_;
}

void upload_scene(const RayCastScene& packed, const Surface& surface, const PictureFrame& frame, GpuScene& scene) {
  scene.primitives.upload(packed.primitives);
  scene.rows.upload(packed.rows);
  scene.counters.upload(std::vector<std::uint32_t>{scene.primitives.count()});
  static_cast<ScenePlacement&>(scene) = place_atoms(surface.atoms, surface.probe_radius, frame);
}

}  // namespace meniscus
