// SPDX-License-Identifier: BSD-3-Clause
// Colours on their way to the GPU.
#include "core/render/gpu_scene.h"

#include "core/render/linear_colors.h"
#include "core/color/coloring.h"

namespace meniscus {

void upload_coloring(const Coloring& coloring, GpuScene& scene) {
  scene.atom_count = static_cast<std::uint32_t>(coloring.atom.size());
  scene.color_by_kind = coloring.kind.has_value();
  scene.some_hidden = coloring.hides_some();
  scene.colors.upload(linear_colors(coloring));
  scene.parts.upload(coloring.part);
}

}  // namespace meniscus
