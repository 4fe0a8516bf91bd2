// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's data in GPU memory, made by the host or by kernels.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/gpu/kernel_lists.h"
#include "core/gpu/buffer.h"

namespace meniscus {

struct Coloring;

/// The records that the host shares with the shaders.
namespace ray_cast {
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#include "gpu_shaders/ray_cast/records.glsl"
static_assert(sizeof(Primitive) == 48 && sizeof(Hit) == 32, "std430 has these sizes");
}  // namespace ray_cast

/// The properties of a scene that depend on atoms, probe and camera alone.
struct PackPlacement {
  float slack = 0.0f;         ///< overlap of patches, Å: a few times the rounding error of the largest coordinate
  double probe_radius = 0.0;  ///< Å
  /// The range of depths along the view axis that contains the atoms, Å. It contains hidden atoms, too, so depth cues
  /// do not depend on the choice of primitives. The GPU's tile lists divide this range into 32 slices.
  float first_depth = 0.0f, last_depth = 0.0f;
};

/// The scene of one picture. Records and rows are described in gpu_shaders/ray_cast/records.glsl. Positions are
/// relative to the pivot of the picture (PictureFrame), so a scene belongs to one camera. Primitives are in any order,
/// and primitives that the picture does not show may be missing; neither changes a bit of the picture.
struct GpuPack : PackPlacement {
  Buffer counters;  ///< uint32 each; word 0 is the number of primitives, which kernels may know before the host does
  AppendList primitives{sizeof(ray_cast::Primitive), 1 << 15};
  AppendList rows{sizeof(glm::vec4), 1 << 17};
  /// Empty, or one float for each tile of 16 x 16 pixels of the picture, row by row. It is a distance from the camera
  /// (orthographic: from its plane) in Å: no primitive that begins beyond it is visible in the tile.
  Buffer tile_depths;

  Buffer colors;  ///< one vec4 per atom, linear, alpha: opacity (0: hidden); if coloured by kind, three more
  std::uint32_t atom_count = 0;
  bool color_by_kind = false;
  bool some_hidden = false;
  std::vector<float> blocks_light;  ///< Coloring::blocking()
  Buffer marks;                     ///< one uint32 per atom, or empty: Coloring::line_marks()
};

/// Uploads the coloring: sets the last five members.
void upload_coloring(const Coloring& coloring, GpuPack& scene);

}  // namespace meniscus
