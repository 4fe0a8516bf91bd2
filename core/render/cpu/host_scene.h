// SPDX-License-Identifier: BSD-3-Clause
// What a picture on the CPU is cast from.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"
#include "core/color/coloring.h"

namespace meniscus {

/// A picture's scene on the host.
struct HostScene {
  RayCastScene packed;
  ScenePlacement placement;
  std::vector<glm::vec4> colors;          ///< linear_colors()
  std::vector<float> parts;               ///< whole numbers that a float holds exactly: only their difference counts
  std::vector<std::uint8_t> keeps_color;  ///< of atoms, if there is a volume map
  LaneScene lanes;                        ///< all of this as the kernels read it, but for its view

  /// What a volume map colours of atoms that follow those of before. For connect().
  void add_paint(const Coloring& coloring, const glm::dvec3& pivot) {
    if (!coloring.volume) return;
    lanes.paint.map = coloring.volume.get();
    lanes.paint.pivot = pivot;
    for (std::uint32_t a = 0; a < coloring.atom.size(); ++a) keeps_color.push_back(coloring.by_volume(a) ? 0 : 1);
  }

  /// Sets `lanes`, once everything else is there. color_by_kind: the last three colours are those of kinds.
  void connect(const Look& look, bool color_by_kind, bool some_hidden) {
    lanes.primitives = packed.primitives.data();
    lanes.rows = packed.rows.data();
    lanes.colors = colors.data();
    lanes.parts = parts.data();
    lanes.some_hidden = some_hidden;
    lanes.paint.keeps_color = keeps_color.data();
    const auto atom_count = static_cast<std::uint32_t>(colors.size() - (color_by_kind ? 3 : 0));
    lanes.params = cast_parameters(placement, look, atom_count, color_by_kind);
  }
};

}  // namespace meniscus
