// SPDX-License-Identifier: BSD-3-Clause
// Selects the RS faces that the paper draws (Krone, Dachsbacher & Ertl 2010, section 3.3), to measure what it leaves
// out.
#pragma once

#include <cstdint>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"
#include "core/render/ray_cast_scene.h"
#include "core/visible_surface/visible_atoms.h"

namespace meniscus {

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
