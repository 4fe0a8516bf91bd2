// SPDX-License-Identifier: BSD-3-Clause
// The paper's pipeline: computes, for every frame on the GPU, the part of the surface that the view needs, from atoms
// to primitives.
#pragma once

#include "core/gpu/buffer.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/reduced_surface/gpu/gpu_arcs.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/render/gl_renderer.h"
#include "core/render/gpu_pack.h"
#include "core/render/picture.h"
#include "core/render/ray_cast_pack.h"
#include "core/surface/primitives.h"
#include "core/visible_surface/visible_atoms.h"

namespace meniscus {

/// Statistics of one view.
struct ViewStats {
  std::size_t atoms = 0;
  std::size_t kept_atoms = 0;  ///< atoms that can matter for a pixel
  std::size_t arcs = 0;        ///< RS edges between kept atoms
  std::size_t probes = 0;      ///< RS faces that can matter for a pixel
  std::size_t primitives = 0;
  CircleStats circles;
  double grown_by = 0.0;  ///< largest growth of radii, Å, to resolve ties, as in Certificate::grown_by
};

/// Draws atoms by the part of the surface that one view needs. Between the stages only counters come back from the GPU,
/// and the few circles that double precision cannot decide. Kernels and buffers are reused from frame to frame. A GL
/// context must be current.
///
/// Its four groups of stages are those of Krone, Dachsbacher & Ertl 2010, section 3: visible atoms; neighbours and
/// potential RS faces and edges; the RS faces that are visible or cut visible ones; primitives and singularities. All
/// atoms still act as blockers. The picture equals that of the complete surface, pixel for pixel. A complete surface
/// does not depend on the camera: for the same atoms and probe its arcs and RS faces are found once.
class ViewPipeline final : public Drawable {
 public:
  /// Sets the van der Waals balls, Å, of one frame; at least one.
  void set_atoms(std::vector<Ball> atoms);
  /// Sets one colour per atom; required after a change of the number of atoms and before the next picture.
  void set_coloring(const Coloring& coloring) { upload_coloring(coloring, scene_); }
  /// Sets the surface of the next pictures; probe_radius in Å, >= 0. The default is 1.4 Å and visible.
  void set_surface(double probe_radius, Extent extent);

  /// Sets whether prepare() reads buffer sizes back between its stages, or assumes the sizes of the last view. The
  /// default is the faster choice for the device.
  void set_counting(Counting counting) { counting_ = counting; }

  std::span<const Ball> atoms() const override { return atoms_; }

  /// Grows the radii slightly where ties keep the arcs around the view from closing (compute_surface.h). Throws
  /// OpenSurfaceError if that does not help, GpuError, CapacityError.
  const GpuPack& prepare(const PictureFrame& frame, StageClock& clock) override;
  void request_counts(Readback& readback) override;
  bool take_counts() override;

  /// Returns the statistics of the last picture.
  const ViewStats& stats() const { return stats_; }

 private:
  void take_atoms(std::vector<Ball> atoms);
  void prepare_once(const PictureFrame& frame, StageClock& clock);
  bool can_trust() const;
  bool take_arc_counts();
  void upload_atoms(StageClock& clock);
  void find_occluders(const PictureFrame& frame, StageClock& clock);
  void keep_atoms(StageClock& clock);
  void find_arcs(StageClock& clock);
  void find_fixed_probes(const PictureFrame& frame, StageClock& clock);
  void make_primitives(const PictureFrame& frame, StageClock& clock);

  void place_probes();
  void select_as_the_paper(const PictureFrame& frame);
  bool is_closed() const;
  void list_arcs_by_atom();
  void find_clips();
  kernel::ConvexParameters convex_parameters(const BallBatch& batch) const;
  void append_primitives(const PictureFrame& frame);
  const Program& primitive_kernel(const char* name, const PictureFrame& frame, const ShaderDefines& defines = {});
  std::uint32_t atom_count() const { return static_cast<std::uint32_t>(atoms_.size()); }

  Counting counting_ = suitable_counting();
  ProgramCache programs_;
  PrefixSum prefix_sum_{programs_};
  GpuArcs arcs_{programs_};
  GpuNeighbors probe_neighbors_{programs_};  // neighbours of fixed probes
  VisibleAtoms visible_{programs_};
  PaperSelection paper_{programs_};
  ViewStats stats_;
  GpuPack scene_;

  // The state of the current frame.
  std::vector<Ball> atoms_;
  SwallowedAtoms swallowing_;
  std::vector<bool> swallowed_;
  glm::dvec3 middle_{0.0};
  BallExtent extent_of_atoms_;  // relative to their middle; radii without the probe
  double probe_radius_ = 1.4;
  Extent extent_ = Extent::visible;
  bool uploaded_ = false;          // true if the atoms with this probe are on the GPU
  bool all_probes_found_ = false;  // true if arcs and probes on the GPU are those of the complete surface
  Buffer radii_;                   // double per atom: van der Waals radius
  std::vector<double> uploaded_radii_;
  AppendList probes_{sizeof(kernel::ProbeRecord), 1 << 13};
  Buffer probe_counters_;
  std::array<std::uint32_t, 7> probe_counts_{};      // probes, then sums over the ends of arcs
  std::array<std::uint32_t, 3> primitive_counts_{};  // primitives, rows, and whether a loop was cut short
  bool trusted_ = false;  // true if the sizes of the last frame are known, and the number of atoms is the same
  bool arcs_open_ = false,
       primitives_open_ = false;  // true while the host still has to read counts of the current frame
  Buffer atom_arc_first_, atom_arc_rank_, atom_arcs_, marked_arcs_;
  Buffer convex_clips_;  // uint per atom: kByPartners ... of shared/parameters.glsl
  TexelBuffer arc_texels_{TexelFormat::uint4}, atom_arc_first_texels_{TexelFormat::uint1},
      atom_arc_texels_{TexelFormat::uint4}, marked_arc_texels_{TexelFormat::uint4};
  std::uint32_t arc_count_ = 0;  // an upper limit
  bool whole_spheres_ = false;   // true: they are drawn instead of convex patches
};

}  // namespace meniscus
