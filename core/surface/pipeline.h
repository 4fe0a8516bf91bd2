// SPDX-License-Identifier: BSD-3-Clause
// The reduced surface on the GPU: grid, neighbours, circles, arcs, each stage a kernel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/gpu/buffer.h"
#include "core/gpu/program.h"
#include "core/surface/primitives.h"
#include "core/surface/reduced_surface.h"

namespace meniscus {

/// How the circles of one frame were decided.
struct PipelineStats {
  std::size_t pairs = 0;             ///< overlapping pairs of SAS balls, each one circle
  std::size_t decided_in_double = 0;  ///< circles that single precision left in doubt
  std::size_t decided_on_host = 0;    ///< circles that double left in doubt, decided in quadruple precision
};

/// Finds reduced surfaces with compute shaders. Keeps kernels and buffers from frame to frame. Needs the GL context it
/// was made in to be current. The result is that of enumerate_reduced_surface(), arc by arc.
/// Based on Krone, Dachsbacher & Ertl 2010, with circles (contour build-up) in place of their atom triples.
class SurfacePipeline {
 public:
  SurfacePipeline();
  ~SurfacePipeline();

  /// atoms in Å, probe_radius >= 0 in Å. Throws GpuError, CapacityError.
  ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius);

  /// Wall-clock times of the stages of the last run, batches added up. (Software GL reports no GPU times.)
  const std::vector<StageTime>& stage_times() const { return clock_.times(); }
  const PipelineStats& stats() const { return stats_; }

 private:
  struct Buffers;

  /// Consecutive atoms whose neighbour lists are on the GPU at one time.
  struct Batch {
    std::uint32_t first_atom = 0;
    std::uint32_t atom_count = 0;
    std::uint32_t neighbor_count = 0;
    std::uint32_t pair_count = 0;
  };

  void upload_atoms(std::span<const Ball> atoms, double probe_radius);
  void build_grid();
  void count_neighbors(Batch& batch);
  void list_neighbors(const Batch& batch);
  void list_pairs(const Batch& batch);
  void expose_circles(const Batch& batch, ReducedSurface& rs);
  void decide_on_host(const Batch& batch, std::span<const glm::uvec2> circles, ReducedSurface& rs);
  void collect_lone_atoms(const Batch& batch, ReducedSurface& rs);
  void run_neighbors(const Batch& batch, int pass);
  void scan(Buffer& words, std::uint32_t count);
  const Program& kernel(const char* name, int pass = -1, bool in_double = false);

  ProgramCache programs_;
  std::unique_ptr<Buffers> buffers_;
  StageClock clock_;
  PipelineStats stats_;

  // The frame at work.
  std::span<const Ball> atoms_;
  std::vector<double> weights_;
  std::vector<bool> swallowed_;
  float largest_radius_ = 0;
  glm::vec4 grid_low_{0.0f};
  glm::vec4 grid_size_{1.0f};
  std::uint32_t cell_count_ = 0;
  std::size_t block_bytes_ = 0;  // largest buffer a kernel sees
};

}  // namespace meniscus
