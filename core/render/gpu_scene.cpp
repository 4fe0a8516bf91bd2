// SPDX-License-Identifier: BSD-3-Clause
// Puts the colours of atoms into GPU memory for the ray caster.
#include "core/render/gpu_scene.h"

#include "core/color/coloring.h"
#include "core/render/linear_colors.h"

namespace meniscus {

void upload_coloring(const Coloring& coloring, GpuScene& scene) {
  scene.atom_count = static_cast<std::uint32_t>(coloring.atom.size());
  scene.color_by_kind = coloring.kind.has_value();
  scene.some_hidden = coloring.hides_some();
  scene.colors.upload(linear_colors(coloring));
  scene.marks.upload(coloring.line_marks());
}

}  // namespace meniscus
