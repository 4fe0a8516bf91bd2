// SPDX-License-Identifier: BSD-3-Clause
// The surface on the GPU: grid, neighbours, circles and arcs of atoms, then cuts and cusps of fixed probes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/gpu/append_list.h"
#include "core/gpu/program.h"
#include "core/surface/cusp_tracer.h"
#include "core/reduced_surface/gpu/gpu_circles.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/surface/primitives.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Finds surfaces with compute shaders. Keeps kernels and buffers from frame to frame. The GL context it was made in
/// must be current. Results equal those of the CPU, arc by arc.
/// Based on Krone, Dachsbacher & Ertl 2010, with circles (contour build-up) in place of their atom triples.
class SurfacePipeline {
 public:
  SurfacePipeline();
  ~SurfacePipeline();

  /// The complete surface; look at its certificate. atoms in Å, probe_radius >= 0 in Å. Throws GpuError, CapacityError.
  Surface run(std::span<const Ball> atoms, double probe_radius);

  /// Only the reduced surface: the result of enumerate_reduced_surface().
  ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius);

  /// Wall-clock times of the stages of the last run, batches added up. (Software GL reports no GPU times.)
  const std::vector<StageTime>& stage_times() const { return clock_.times(); }
  const CircleStats& stats() const { return circles_.stats(); }

 private:
  void upload(std::span<const Ball> atoms, double probe_radius);
  void list_lone_atoms(const BallBatch& batch);

  ProgramCache programs_;
  GpuNeighbors neighbors_;
  GpuCircles circles_;
  std::unique_ptr<CuspTracer> cusp_tracer_;
  StageClock clock_;
  std::vector<double> weights_;  // of the frame at work
  AppendList lone_atoms_{sizeof(std::uint32_t), 1 << 12};
  Buffer counters_;
};

/// Cuts and cusp arcs with compute shaders; doubtful ones are decided on the host. The context must be current.
std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs);

}  // namespace meniscus
