// SPDX-License-Identifier: BSD-3-Clause
// RS edges on the GPU: the exposed arcs of all circles, single precision first, doubt in double, the rest on the host.
#pragma once

#include "core/gpu/kernel_lists.h"
#include "core/gpu/buffer.h"
#include "core/gpu/program.h"
#include "core/math/ball.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// The kernel "circles" and its buffers. A GL context must be current.
class GpuCircles {
 public:
  GpuCircles(ProgramCache& programs, GpuNeighbors& neighbors) : programs_(programs), neighbors_(neighbors) {}

  /// Uploads new atoms or a new probe. weights: decision weights. Both must stay valid until the last expose().
  /// roundoff: decisions of double precision with a smaller relative margin are made on the host, where ties are
  /// counted; 0: only those within rounding.
  void upload(std::span<const Ball> atoms, std::span<const double> weights, double roundoff);

  /// Clears all arcs and statistics.
  void restart();

  /// Appends the arcs of the batch's circles, in any order. Its pairs must have been listed. Adds times to `clock`.
  void expose(const BallBatch& batch, StageClock& clock);

  /// Appends the arcs of a single batch without reading back their number: no circle may be left to the host, and lists
  /// must have had room. The counts come back with the frame; take_counts() returns true if both held.
  void expose_later(const BallBatch& batch, StageClock& clock);
  void request_counts(Readback& readback);
  bool take_counts(const BallBatch& batch);
  /// Writes the number of arcs that the host knows to the buffer that kernels read.
  void upload_count();

  /// Returns the counters for kernels: word 0 is the number of arcs, which may exceed the room.
  const Buffer& counters() const { return counters_; }

  Buffer atoms;  ///< dvec4 per atom: centre in Å, decision weight
  AppendList arcs{sizeof(RsArc), 1 << 14};
  const CircleStats& stats() const { return stats_; }

 private:
  void run(const BallBatch& batch, bool in_double, std::uint32_t circle_count);
  void start(const BallBatch& batch, bool in_double, std::uint32_t circle_count);
  void decide_on_host(const BallBatch& batch, std::vector<glm::uvec2> circles);

  ProgramCache& programs_;
  GpuNeighbors& neighbors_;
  std::span<const Ball> host_atoms_;
  std::span<const double> weights_;
  double roundoff_ = 0;
  std::vector<glm::dvec4> exact_;                    // memory of upload(), reused
  TexelBuffer relative_texels_{TexelFormat::uint4};  // the neighbours, which circles fetch most
  AppendList doubtful_{sizeof(glm::uvec2), 1 << 12}, still_doubtful_{sizeof(glm::uvec2), 1 << 12};
  Buffer counters_;
  std::array<std::uint32_t, 3> counts_{};  // numbers of arcs, and of doubtful circles in single precision and in double
  CircleStats stats_;
};

/// Runs grid, neighbours, circles and arcs, batch by batch. Kernels and buffers are reused from frame to frame. A GL
/// context must be current.
class GpuArcs {
 public:
  explicit GpuArcs(ProgramCache& programs) : neighbors(programs), circles(programs, neighbors) {}

  /// Uploads van der Waals balls, Å, which must stay valid until the last find(). Swallowed atoms have no patch and
  /// block nothing. From now on all atoms are listed. watch_ties: circles.stats() counts ties, at a small cost.
  void upload(std::span<const Ball> atoms, const std::vector<bool>& swallowed, double probe_radius,
              bool watch_ties = false);

  /// Returns the decision weights of the atoms.
  std::span<const double> weights() const { return weights_; }

  /// Computes `circles.arcs`, in any order: the arcs of all circles of two atoms that are listed
  /// (neighbors.list_only()). All atoms block. Throws GpuError, CapacityError.
  void find(StageClock& clock);

  /// Computes the arcs without reading back any count, where neighbors.can_trust(): see GpuCircles::expose_later().
  void find_later(StageClock& clock);
  void request_counts(Readback& readback);
  bool take_counts();

  GpuNeighbors neighbors;
  GpuCircles circles;

 private:
  std::vector<double> weights_;
};

}  // namespace meniscus
