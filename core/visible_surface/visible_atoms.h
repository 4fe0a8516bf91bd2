// SPDX-License-Identifier: BSD-3-Clause
// Finds the atoms that can matter for a pixel of one view, on the GPU (theorem 2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/gpu/buffer.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/program.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Kernels of gpu_shaders/visibility and their buffers. A GL context must be current.
///
/// Theorem: if atom a makes or cuts a point x that a ray shows, then x lies within r_a + 2p of its centre; and x lies
/// in front of the nearest van der Waals sphere of the ray, as long as the eye is in the solvent, because that sphere
/// lies in the solid. So an atom is needed only if the ball of radius r_a + 2p begins in front of the nearest vdW
/// sphere on some ray. The spheres are drawn into blocks of pixels, each with a depth by which all its rays have met
/// one. Balls are tested block by block with bounds that hold for every ray of the block, so that no atom is missed.
class VisibleAtoms {
 public:
  explicit VisibleAtoms(ProgramCache& programs) : programs_(programs), prefix_sum_(programs) {}

  /// Starts one view of `atoms`, whose middle is `middle`; must come before everything else. Returns whether the
  /// theorem applies: an eye in the solid sees walls behind vdW spheres, and then all atoms are kept, as with
  /// `keep_all`.
  void look(std::span<const Ball> atoms, const glm::dvec3& middle, double probe_radius, const PictureFrame& frame,
            bool keep_all);

  /// True if this view keeps all atoms.
  bool keeps_all() const { return view_.keep_all != 0; }

  /// Draws the vdW spheres. balls: vec4 per atom, centre from the middle and SAS radius. Writes tile_depths in the form
  /// of GpuScene; that buffer must stay valid.
  void draw_occluders(const Buffer& balls, std::uint32_t atom_count, Buffer& tile_depths);

  /// Lists the atoms to keep and returns their number; with Counting::later, an upper limit based on the last number.
  /// balls_low: w is 1 for swallowed atoms, which are not kept.
  std::uint32_t keep(const Buffer& balls, const Buffer& balls_low, std::uint32_t atom_count, Counting counting);
  /// Returns that upper limit for this number of atoms.
  std::uint32_t most_kept(std::uint32_t atom_count) const { return std::min(atom_count, known_ + known_ / 8 + 64); }
  /// For Counting::later: requests the counts that the host needs, which also show whether the limit held.
  void ask(Readback& readback);
  bool settle();
  /// Returns the number as counted last.
  std::uint32_t known() const { return known_; }

  /// Binds the parameters of kernels that include begins_in_front.glsl, and the textures at units 4 and 5.
  void bind(const Program& program) const;

  Buffer kept;    ///< ascending atom indices
  Buffer before;  ///< per atom, and one more: number of kept atoms before it

 private:
  bool theorem_applies(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame) const;

  ProgramCache& programs_;
  PrefixSum prefix_sum_;
  Buffer block_depths_;
  TexelBuffer tile_texels_{TexelFormat::uint1}, block_texels_{TexelFormat::uint1};
  float probe_radius_ = 0.0f;
  glm::ivec2 tiles_{0};
  kernel::View view_{};
  std::uint32_t known_ = 0, counted_ = 0;
  std::uint32_t trusted_ = 0;  // upper limit in the current frame
};

}  // namespace meniscus
