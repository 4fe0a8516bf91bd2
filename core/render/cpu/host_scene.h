// SPDX-License-Identifier: BSD-3-Clause
// What a picture on the CPU is cast from.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {

/// A picture's scene on the host.
struct HostScene {
  RayCastScene packed;
  ScenePlacement placement;
  std::vector<glm::vec4> colors;  ///< linear_colors()
  std::vector<float> parts;       ///< whole numbers that a float holds exactly: only their difference counts
  LaneScene lanes;                ///< all of this as the kernels read it, but for its view

  /// Sets `lanes`, once everything else is there. color_by_kind: the last three colours are those of kinds.
  void connect(const Look& look, bool color_by_kind, bool some_hidden) {
    lanes.primitives = packed.primitives.data();
    lanes.rows = packed.rows.data();
    lanes.colors = colors.data();
    lanes.parts = parts.data();
    lanes.some_hidden = some_hidden;
    const auto atom_count = static_cast<std::uint32_t>(colors.size() - (color_by_kind ? 3 : 0));
    lanes.params = cast_parameters(placement, look, atom_count, color_by_kind);
  }
};

}  // namespace meniscus
