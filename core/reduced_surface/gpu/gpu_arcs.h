// SPDX-License-Identifier: BSD-3-Clause
// RS edges on the GPU: the exposed arcs of all atoms, or of those that a view keeps.
#pragma once

#include <span>
#include <vector>

#include "core/gpu/program.h"
#include "core/reduced_surface/gpu/gpu_circles.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"

namespace meniscus {

class StageClock;

/// Grid, neighbours, circles and arcs, batch by batch. Keeps kernels and buffers from frame to frame. Needs a current
/// GL context.
class GpuArcs {
 public:
  explicit GpuArcs(ProgramCache& programs) : neighbors(programs), circles(programs, neighbors) {}

  /// Van der Waals balls, Å, which must stay until the last find(); `swallowed` says who has no patch and blocks
  /// nothing. From now on all of them are listed. watch_ties: circles.stats() counts ties, which costs a little.
  void upload(std::span<const Ball> atoms, const std::vector<bool>& swallowed, double probe_radius,
              bool watch_ties = false);

  /// Decision weights of the atoms.
  std::span<const double> weights() const { return weights_; }

  /// Fills `circles.arcs`, in any order: the arcs of all circles of two atoms that are listed (neighbors.list_only()).
  /// All atoms block. Throws GpuError, CapacityError.
  void find(StageClock& clock);

  /// The same without asking for any count, where neighbors.can_trust(): see GpuCircles::expose_later().
  void find_later(StageClock& clock);
  void ask(Readback& readback);
  bool settle();

  GpuNeighbors neighbors;
  GpuCircles circles;

 private:
  std::vector<double> weights_;
};

}  // namespace meniscus
