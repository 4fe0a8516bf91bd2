// SPDX-License-Identifier: BSD-3-Clause
// Neighbour lists of balls on the GPU, batch by batch: of atoms for RS edges, of fixed probes for cusps.
#pragma once

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
  std::uint32_t entry = 0;            ///< entry of the lists
  std::uint32_t ball = 0;             ///< ball of the entry
  std::uint32_t first = 0;            ///< place of its first neighbour in the lists
  std::vector<std::uint32_t> labels;  ///< indices of its neighbours
};

/// The box around the centres of balls, in the coordinates of the buffer `balls`, Å, and the largest radius.
struct BallExtent {
  glm::dvec3 low{0.0}, high{0.0};
  double largest_radius = 0.0;
};

/// Returns the extent of balls in their own coordinates; zeros if there are none.
BallExtent extent_of(std::span<const Ball> balls);

/// The kernels "grid", "neighbors", "pairs" and their buffers. A GL context must be current.
class GpuNeighbors {
 public:
  explicit GpuNeighbors(ProgramCache& programs) : programs_(programs), scan_(programs) {}

  /// Sorts balls into a grid: centres and radii in Å. `left_out` may be empty; balls left out neither have nor are
  /// neighbours.
  void upload(std::span<const glm::dvec3> centers, std::span<const double> radii, const std::vector<bool>& left_out);
  /// Sorts balls into a grid with a known box around their centres; ball_at(n) returns ball n.
  template <typename BallAt>
  void upload(std::uint32_t count, const BallExtent& box, const std::vector<bool>& left_out, const BallAt& ball_at);

  /// Takes balls that a kernel has written to `balls` and `balls_low`.
  void adopt(std::uint32_t count, const BallExtent& extent);
  /// Takes at most `most` such balls, with their number in a word of `counts`.
  void adopt(std::uint32_t most, const BallExtent& extent, const Buffer& counts, std::size_t byte_offset);

  /// Restricts lists to these balls, and pairs to two of them; all balls are still listed as neighbours. listed:
  /// `count` ascending indices; before: per ball and one more, the number of listed balls before it. Batches count
  /// entries of `listed`. Both buffers must stay valid. upload() and adopt() list all balls again. `count` may be too
  /// large: lists after the last one are empty.
  void list_only(const Buffer& listed, const Buffer& before, std::uint32_t count);

  /// Returns the number of entries of the lists; with list_only() it may be too large.
  std::uint32_t entry_count() const { return entry_count_; }

  /// Sets how lists are counted. With Counting::later lists get the room that they needed last time and some more, in
  /// one batch, which must suffice for all: can_trust(). Valid until the next call.
  void count_lists(Counting counting) { counting_ = counting; }
  /// True if this many balls fit into one batch, and the sizes of such a batch are known.
  bool can_trust(std::uint32_t entry_count) const { return entry_count <= kLargestBatch && known_.count > 0; }
  /// For Counting::later: requests the counts that the host needs, which also show whether there was room.
  void request_counts(Readback& readback);
  bool take_counts();
  /// Returns the size for kernels beyond which a list has no room.
  std::uint32_t list_limit() const { return counting_ == Counting::later ? trusted_.neighbor_count : ~0u; }
  /// Returns the sizes of the lists as they were counted last.
  const BallBatch& known() const { return known_; }

  /// Returns the defines of kernels that include listed_balls.glsl, and binds their two textures to units 2 and 3.
  ShaderDefines list_defines() const;
  void bind_listed() const;

  /// Reads a single entry of the current batch back from the GPU.
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
  static constexpr std::uint32_t kLargestBatch = 1 << 16;  // 50 MB of lists: within limits and near caches

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
  TexelBuffer ball_texels_{TexelFormat::uint4}, cell_texels_{TexelFormat::uint1};  // texels of balls and cell_atoms_
  TexelBuffer listed_texels_{TexelFormat::uint1}, before_texels_{TexelFormat::uint1};
  Buffer cell_first_, rank_, cell_atoms_, class_counts_;
  Buffer ball_count_;   // uint: true if loops were cut short; uint: number of balls
  BallBatch resident_;  // the batch whose lists the buffers hold; count 0: none
  Counting counting_ = Counting::now;
  BallBatch known_, trusted_;  // sizes of one batch: as last counted, and with spare room
  struct Counted {
    std::uint32_t cut_short = 0, neighbors = 0, pairs = 0;
  } counted_;
  std::uint32_t count_ = 0;
  std::uint32_t entry_count_ = 0;  // number of entries: count_, or that of list_only()
  const Buffer* listed_ = nullptr;
  std::uint32_t cell_count_ = 0;
  float largest_radius_ = 0;
  kernel::CellGrid grid_{};
  std::vector<glm::vec4> coarse_, fine_;  // memory of upload(), reused
};

// A centre is uploaded as two floats each, relative to the middle of all, so that differences have single precision.
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
