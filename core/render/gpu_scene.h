// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's data in GPU memory; host code or kernels make it.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/gpu/kernel_lists.h"
#include "core/gpu/buffer.h"

namespace meniscus {

struct Coloring;

/// Records shared with the shaders.
namespace ray_cast {
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#include "gpu_shaders/ray_cast/records.glsl"
static_assert(sizeof(Primitive) == 48 && sizeof(Hit) == 32, "std430 has these sizes");
}  // namespace ray_cast

/// What of a scene follows from atoms, probe and camera alone.
struct ScenePlacement {
  float slack = 0.0f;         ///< Å by which patches overlap: a few roundings of the largest coordinate
  double probe_radius = 0.0;  ///< Å
  /// The atoms lie between these depths along the view axis, Å: all atoms, shown or not, so that depth cues do not
  /// depend on which primitives are here. The GPU's tile lists are made of 32 slices of this range.
  float first_depth = 0.0f, last_depth = 0.0f;
};

/// Records and rows are those of gpu_shaders/ray_cast/records.glsl. Positions are relative to the pivot of the picture
/// (PictureFrame), so that a scene belongs to one camera. Primitives are in any order; what the picture does not show
/// may be there or not: the picture is the same to the bit.
struct GpuScene : ScenePlacement {
  Buffer counters;  ///< uint32 each; word 0: how many primitives there are, which kernels may know before the host
  AppendList primitives{sizeof(ray_cast::Primitive), 1 << 15};
  AppendList rows{sizeof(glm::vec4), 1 << 17};
  /// Empty, or one float for each tile of 16 x 16 pixels of the picture, row by row: a distance from the camera
  /// (orthographic: from its plane), in Å, beyond which nothing that begins there can show in the tile.
  Buffer tile_depths;

  Buffer colors;  ///< vec4 per atom, linear, alpha: opacity (0: hidden); then, if by kind, three for these
  std::uint32_t atom_count = 0;
  bool color_by_kind = false;
  bool some_hidden = false;
  Buffer marks;  ///< uint32 per atom, or empty: Coloring::line_marks()
};

/// Sets the last five members.
void upload_coloring(const Coloring& coloring, GpuScene& scene);

}  // namespace meniscus
