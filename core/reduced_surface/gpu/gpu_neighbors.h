// SPDX-License-Identifier: BSD-3-Clause
// Neighbour lists of balls on the GPU, batch by batch: of atoms for RS edges, of fixed probes for cusps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/gpu/buffer.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/program.h"
#include "core/math/ball.h"

namespace meniscus {

/// Consecutive balls whose neighbour lists are on the GPU at one time.
struct BallBatch {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t neighbor_count = 0;
  std::uint32_t pair_count = 0;
};

/// The neighbours of one ball, on the host.
struct NeighborList {
  std::uint32_t entry = 0;            ///< of the lists
  std::uint32_t ball = 0;             ///< that the entry stands for
  std::uint32_t first = 0;            ///< place of its first neighbour in the lists
  std::vector<std::uint32_t> labels;  ///< indices of its neighbours
};

/// Where balls are and how large they get: a box around their centres, in the coordinates of the buffer `balls`, Å.
struct BallExtent {
  glm::dvec3 low{0.0}, high{0.0};
  double largest_radius = 0.0;
};

/// That of balls as they are; nothing but zeros for none.
BallExtent extent_of(std::span<const Ball> balls);

/// Kernels "grid", "neighbors", "pairs" and their buffers. Needs a current GL context.
class GpuNeighbors {
 public:
  explicit GpuNeighbors(ProgramCache& programs) : programs_(programs), scan_(programs) {}

  /// Puts balls into a grid: centres and radii in Å; `left_out` may be empty or say who neither has nor is a neighbour.
  void upload(std::span<const glm::dvec3> centers, std::span<const double> radii, const std::vector<bool>& left_out);
  /// The same for a box around the centres, as they are, that is known already; the centre and the radius of ball n are
  /// made by ball_at(n).
  template <typename BallAt>
  void upload(std::uint32_t count, const BallExtent& box, const std::vector<bool>& left_out, const BallAt& ball_at);

  /// Takes balls that a kernel has written to `balls` and `balls_low`.
  void adopt(std::uint32_t count, const BallExtent& extent);
  /// The same for no more than `most` balls, whose number is a word of `counts`.
  void adopt(std::uint32_t most, const BallExtent& extent, const Buffer& counts, std::size_t byte_offset);

  /// From now on lists are made for these balls only, and pairs of two of them; all are still listed as neighbours.
  /// listed: `count` ascending indices; before: per ball and one more, how many listed ones come before it. Batches
  /// count entries of `listed`. Both buffers must stay. upload() and adopt() list all again. The count may be larger
  /// than it is: after the last one lists are empty.
  void list_only(const Buffer& listed, const Buffer& before, std::uint32_t count);

  /// Of the lists; with list_only() perhaps more than there are.
  std::uint32_t entry_count() const { return entry_count_; }

  /// With Counting::later lists get the room that they needed last time and some more, in one batch, which must suffice
  /// for all: can_trust(). Holds until it is called again.
  void count_lists(Counting counting) { counting_ = counting; }
  /// Whether so many balls fit into one batch, and the sizes of such a batch are known.
  bool can_trust(std::uint32_t entry_count) const { return entry_count <= kLargestBatch && known_.count > 0; }
  /// For Counting::later: what the host has to know, and, once that has been read back, whether there was room.
  void ask(Readback& readback);
  bool settle();
  /// For kernels: lists that have come so far had no room for all.
  std::uint32_t list_limit() const { return counting_ == Counting::later ? trusted_.neighbor_count : ~0u; }
  /// Sizes of the lists as they were counted last.
  const BallBatch& known() const { return known_; }

  /// What kernels that include listed_balls.glsl need: their define, and their two textures bound to units 2 and 3.
  ShaderDefines list_defines() const;
  void bind_listed() const;

  /// Reads one entry of the batch at hand, and nothing else, back from the GPU.
  NeighborList list_of(const BallBatch& batch, std::uint32_t entry) const;

  /// Calls work(batch) for consecutive batches with their lists in the buffers below; lists that are still there from
  /// the last time are not made again. Batches are as large as the driver's storage blocks allow. Throws CapacityError
  /// if a single ball has too many neighbours.
  template <typename Work>
  void for_each_batch(Work&& work) {
    BallBatch batch;
    batch.count = std::min(kLargestBatch, entry_count_);
    while (batch.first < entry_count_) {
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
      batch.count = std::min(batch.count, entry_count_ - batch.first);
    }
  }

  /// Lists each overlapping pair i < j of the batch once, in `pairs`.
  void list_pairs(const BallBatch& batch);

  Buffer balls;       ///< vec4 per ball: centre from the middle (high part), radius
  Buffer balls_low;   ///< vec4 per ball: low part of the centre; w: 1 for balls left out
  Buffer first;       ///< uint per ball of the batch + 1: into the two lists
  Buffer relative;    ///< vec4 per neighbour: centre from the ball's, radius²; roughly nearest first
  Buffer labels;      ///< uint per neighbour: its index
  Buffer pair_first;  ///< uint per ball of the batch + 1: into the pairs
  Buffer pairs;       ///< uvec2 per pair: entry of the ball, place of the other in the lists

 private:
  static constexpr std::size_t kClasses = 6;               // distance classes of the kernel
  static constexpr std::uint32_t kLargestBatch = 1 << 16;  // lists of some 50 MB: within limits and not far from caches

  bool count_neighbors(BallBatch& batch);
  void scan_counts(BallBatch& batch);
  void read_counts(BallBatch& batch);
  void adopt_extent(const BallExtent& extent_of_balls);
  void list_neighbors(const BallBatch& batch);
  void run_neighbors(const BallBatch& batch, int pass);
  void build_grid();
  const Program& kernel(const char* name, int pass = -1);

  ProgramCache& programs_;
  PrefixSum scan_;
  TexelBuffer ball_texels_{TexelFormat::uint4}, cell_texels_{TexelFormat::uint1};  // of balls and cell_atoms_
  TexelBuffer listed_texels_{TexelFormat::uint1}, before_texels_{TexelFormat::uint1};
  Buffer cell_first_, rank_, cell_atoms_, class_counts_;
  Buffer ball_count_;   // uint, whether loops were cut short; uint, how many balls there are
  BallBatch resident_;  // whose lists the buffers hold; count 0: none
  Counting counting_ = Counting::now;
  BallBatch known_, trusted_;  // of one batch: as last counted, with room
  struct Counted {
    std::uint32_t cut_short = 0, neighbors = 0, pairs = 0;
  } counted_;
  std::uint32_t count_ = 0;
  std::uint32_t entry_count_ = 0;  // of the lists: count_, or that of list_only()
  const Buffer* listed_ = nullptr;
  std::uint32_t cell_count_ = 0;
  float largest_radius_ = 0;
  kernel::CellGrid grid_{};
  std::vector<glm::vec4> coarse_, fine_;  // of upload(), kept for their memory
};

// A centre goes up as two floats each from the middle of all; their difference is good to single precision anywhere.
template <typename BallAt>
void GpuNeighbors::upload(std::uint32_t count, const BallExtent& box, const std::vector<bool>& left_out,
                          const BallAt& ball_at) {
  const glm::dvec3 middle = 0.5 * (box.low + box.high);
  coarse_.resize(count);
  fine_.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 4096), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n) {
      const Ball ball = ball_at(n);
      const glm::dvec3 d = ball.center - middle;
      coarse_[n] = glm::vec4(glm::vec3(d), static_cast<float>(ball.radius));
      fine_[n] =
          glm::vec4(glm::vec3(d - glm::dvec3(glm::vec3(coarse_[n]))), !left_out.empty() && left_out[n] ? 1.0f : 0.0f);
    }
  });
  balls.upload(coarse_);
  balls_low.upload(fine_);
  adopt(count, {box.low - middle, box.high - middle, box.largest_radius});
}

}  // namespace meniscus
