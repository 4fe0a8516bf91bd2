// SPDX-License-Identifier: BSD-3-Clause
// The atoms that can matter for a pixel of one view, found on the GPU (theorem 2), and the RS faces that the paper
// draws (Krone, Dachsbacher & Ertl 2010, section 3.3), to measure what it leaves out.
#pragma once

#include "core/gpu/buffer.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/render/ray_cast_pack.h"
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
  void begin_view(std::span<const Ball> atoms, const glm::dvec3& middle, double probe_radius, const PictureFrame& frame,
                  bool keep_all);

  /// True if this view keeps all atoms.
  bool keeps_all() const { return view_.keep_all != 0; }

  /// Draws the vdW spheres. balls: vec4 per atom, centre from the middle and SAS radius. Writes tile_depths in the form
  /// of GpuPack; that buffer must stay valid.
  void draw_occluders(const Buffer& balls, std::uint32_t atom_count, Buffer& tile_depths);

  /// Lists the atoms to keep and returns their number; with Counting::later, an upper limit based on the last number.
  /// balls_low: w is 1 for swallowed atoms, which are not kept.
  std::uint32_t keep(const Buffer& balls, const Buffer& balls_low, std::uint32_t atom_count, Counting counting);
  /// Returns that upper limit for this number of atoms.
  std::uint32_t most_kept(std::uint32_t atom_count) const { return std::min(atom_count, known_ + known_ / 8 + 64); }
  /// For Counting::later: requests the counts that the host needs, which also show whether the limit held.
  void request_counts(Readback& readback);
  bool take_counts();
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

/// Arcs and fixed probes on the GPU.
struct RollingBuffers {
  Buffer* arcs = nullptr;       ///< RsArc each
  Buffer* probes = nullptr;     ///< ProbeRecord each
  Buffer* balls = nullptr;      ///< vec4 per probe: centre from the middle of the atoms, radius
  Buffer* balls_low = nullptr;  ///< vec4 per probe: low part of the centre
  std::uint32_t arc_count = 0;
  std::uint32_t probe_count = 0;
};

/// Kernels of gpu_shaders/paper_selection and their buffers. A GL context must be current.
///
/// An atom is visible if its vdW sphere shows at the centre of a pixel. An RS face is visible if it has a visible atom
/// and shows among all such faces. The selection adds the faces across their edges, and leaves out everything else,
/// including cutting probes in deep clefts. Whole vdW spheres are drawn.
class PaperSelection {
 public:
  explicit PaperSelection(ProgramCache& programs) : programs_(programs) {}

  /// Removes from the complete lists what the paper does not draw. atom_balls: vec4 per atom, centre from the middle
  /// and SAS radius; view: that of the frame.
  void select(const PictureFrame& frame, const VisibleAtoms& view, const Buffer& atom_balls, std::uint32_t atom_count,
              double probe_radius, RollingBuffers& rolling);

  /// Returns a buffer with 1 for each atom whose sphere is drawn.
  const Buffer& drawn() const { return drawn_; }

 private:
  void draw(const char* kernel, const PictureFrame& frame, const VisibleAtoms& view, std::uint32_t group_count,
            float probe_radius);
  void keep_arcs(RollingBuffers& rolling);
  void keep_probes(RollingBuffers& rolling);
  std::uint32_t counted() const;

  ProgramCache& programs_;
  Buffer pixel_depths_, visible_, selected_, face_table_, drawn_, counter_;
  Buffer kept_arcs_, kept_probes_, kept_balls_, kept_balls_low_;
  TexelBuffer arc_texels_{TexelFormat::uint4};
};

}  // namespace meniscus
