// SPDX-License-Identifier: BSD-3-Clause
// Neighbour lists of balls on the GPU, batch by batch: of atoms for RS edges, of fixed probes for cusps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"
#include "core/gpu/texel_buffer.h"

namespace meniscus {

/// Consecutive balls whose neighbour lists are on the GPU at one time.
struct BallBatch {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t neighbor_count = 0;
  std::uint32_t pair_count = 0;
};

/// Kernels "grid", "neighbors", "pairs" and their buffers. Needs a current GL context.
class GpuNeighbors {
 public:
  explicit GpuNeighbors(ProgramCache& programs) : programs_(programs) {}

  /// Puts balls into a grid: centres and radii in Å; `left_out` may be empty or say who neither has nor is a neighbour.
  void upload(std::span<const glm::dvec3> centers, std::span<const double> radii, const std::vector<bool>& left_out);

  /// Calls work(batch) for consecutive batches with their lists in the buffers below; lists that are still there from
  /// the last time are not made again. Batches are as large as the driver's storage blocks allow. Throws CapacityError
  /// if a single ball has too many neighbours.
  template <typename Work>
  void for_each_batch(Work&& work) {
    BallBatch batch;
    batch.count = std::min(kLargestBatch, count_);
    while (batch.first < count_) {
      const bool listed = resident_.count > 0 && resident_.first == batch.first && resident_.count == batch.count;
      if (listed) batch = resident_;
      if (listed || count_neighbors(batch)) {
        if (!listed) list_neighbors(batch);
        resident_ = batch;
        work(batch);
        batch.first += batch.count;
      } else {
        batch.count = (batch.count + 1) / 2;
      }
      batch.count = std::min(batch.count, count_ - batch.first);
    }
  }

  /// Lists each overlapping pair i < j of the batch once, in `pairs`.
  void list_pairs(const BallBatch& batch);

  Buffer balls;     ///< vec4 per ball: centre from the middle (high part), radius
  Buffer first;     ///< uint per ball of the batch + 1: into the two lists
  Buffer relative;  ///< vec4 per neighbour: centre from the ball's, radius²; roughly nearest first
  Buffer labels;    ///< uint per neighbour: its index
  Buffer pairs;     ///< uvec2 per pair: ball, place of the other in the lists

 private:
  static constexpr std::size_t kClasses = 6;               // distance classes of the kernel
  static constexpr std::uint32_t kLargestBatch = 1 << 16;  // lists of some 50 MB: within limits and not far from caches

  bool count_neighbors(BallBatch& batch);
  void list_neighbors(const BallBatch& batch);
  void run_neighbors(const BallBatch& batch, int pass);
  void build_grid();
  void scan(Buffer& words, std::uint32_t count);
  const Program& kernel(const char* name, int pass = -1);

  ProgramCache& programs_;
  TexelBuffer ball_texels_{TexelFormat::uint4}, cell_texels_{TexelFormat::uint1};  // of balls and cell_atoms_
  Buffer balls_low_, cell_first_, rank_, cell_atoms_, totals_, pair_first_, class_counts_;
  BallBatch resident_;  // whose lists the buffers hold; count 0: nobody's
  std::uint32_t count_ = 0;
  std::uint32_t cell_count_ = 0;
  float largest_radius_ = 0;
  glm::vec4 grid_low_{0.0f};
  glm::vec4 grid_size_{1.0f};
};

/// Groups of 64 invocations, the local size of every kernel here.
std::size_t group_count(std::size_t invocations);

}  // namespace meniscus
