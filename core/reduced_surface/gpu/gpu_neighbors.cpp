// SPDX-License-Identifier: BSD-3-Clause
// Runs the grid and neighbour kernels and sizes their lists.
#include "core/reduced_surface/gpu/gpu_neighbors.h"

#include <tbb/parallel_reduce.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/gpu/context_description.h"

namespace meniscus {
BallExtent extent_of(std::span<const Ball> balls) {
  if (balls.empty()) return {};
  // Minimum and maximum do not depend on the order.
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, balls.size(), 4096), BallExtent{balls[0].center, balls[0].center, 0.0},
      [&](const auto& range, BallExtent extent) {
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          extent.low = glm::min(extent.low, balls[n].center);
          extent.high = glm::max(extent.high, balls[n].center);
          extent.largest_radius = std::max(extent.largest_radius, balls[n].radius);
        }
        return extent;
      },
      [](const BallExtent& a, const BallExtent& b) {
        return BallExtent{glm::min(a.low, b.low), glm::max(a.high, b.high),
                          std::max(a.largest_radius, b.largest_radius)};
      });
}

const Program& GpuNeighbors::kernel(const char* name, int pass) {
  ShaderDefines defines = list_defines();
  if (pass >= 0) defines.emplace_back("PASS", std::to_string(pass));
  return programs_.get(std::string("gpu_shaders/") + name + ".comp", defines);
}

void GpuNeighbors::upload(std::span<const glm::dvec3> centers, std::span<const double> radii,
                          const std::vector<bool>& left_out) {
  if (centers.empty()) return adopt(0, {});
  BallExtent box{centers[0], centers[0], 0.0};
  for (std::size_t n = 0; n < centers.size(); ++n) {
    box.low = glm::min(box.low, centers[n]);
    box.high = glm::max(box.high, centers[n]);
    box.largest_radius = std::max(box.largest_radius, radii[n]);
  }
  upload(static_cast<std::uint32_t>(centers.size()), box, left_out, [&](std::uint32_t n) {
    return Ball{centers[n], radii[n]};
  });
}

void GpuNeighbors::adopt(std::uint32_t count, const BallExtent& extent) {
  count_ = entry_count_ = count;
  ball_count_.upload(std::vector<std::uint32_t>{0, count});
  adopt_extent(extent);
}

void GpuNeighbors::adopt(std::uint32_t most, const BallExtent& extent, const Buffer& counts, std::size_t byte_offset) {
  count_ = entry_count_ = most;
  ball_count_.upload(std::vector<std::uint32_t>{0, 0});
  ball_count_.copy(counts, byte_offset, kWord, kWord);
  adopt_extent(extent);
}

void GpuNeighbors::adopt_extent(const BallExtent& extent_of_balls) {
  const auto& [low, high, largest] = extent_of_balls;
  listed_ = nullptr;
  resident_ = {};
  if (count_ == 0) return;
  const glm::dvec3 extent = high - low;
  largest_radius_ = static_cast<float>(largest) * 1.00001f;
  const double spacing = grid_spacing(extent, count_, std::max(1e-3, static_cast<double>(largest_radius_)));
  grid_.low = glm::vec4(glm::vec3(low), static_cast<float>(1 / spacing));
  grid_.size = glm::vec4(glm::vec3(glm::floor(extent / spacing) + 1.0), 0.0f);
  cell_count_ = static_cast<std::uint32_t>(grid_.size.x * grid_.size.y * grid_.size.z);
  build_grid();
}

void GpuNeighbors::build_grid() {
  cell_first_.resize((cell_count_ + 1) * kWord);
  cell_first_.fill(0);
  rank_.resize(count_ * kWord);
  cell_atoms_.resize(count_ * kWord);
  for (int pass = 0; pass < 2; ++pass) {
    balls.bind(0);
    cell_first_.bind(1);
    rank_.bind(2);
    cell_atoms_.bind(3);
    ball_count_.bind(4);
    const Program& program = kernel("reduced_surface/grid", pass);
    program.set(kernel::GridParameters{.atom_count = count_});
    program.set(grid_, kernel::kCellGridBinding);
    program.dispatch(group_count(count_));
    if (pass == 0) scan_(cell_first_, cell_count_);
  }
  ball_texels_.view(balls);
  cell_texels_.view(cell_atoms_);
}

void GpuNeighbors::list_only(const Buffer& listed, const Buffer& before, std::uint32_t count) {
  listed_texels_.view(listed);
  before_texels_.view(before);
  entry_count_ = count;
  listed_ = &listed;
  resident_ = {};
}

ShaderDefines GpuNeighbors::list_defines() const { return listed_ ? ShaderDefines{{"LISTED", "1"}} : ShaderDefines{}; }

NeighborList GpuNeighbors::list_of(const BallBatch& batch, std::uint32_t entry) const {
  NeighborList list;
  list.entry = list.ball = entry;
  if (listed_) listed_->read(entry * kWord, &list.ball, kWord);
  const auto ends = first.download<std::uint32_t>(2, (entry - batch.first) * kWord);
  list.first = ends[0];
  list.labels = labels.download<std::uint32_t>(ends[1] - ends[0], ends[0] * kWord);
  return list;
}

void GpuNeighbors::bind_listed() const {
  if (!listed_) return;
  listed_texels_.bind(2);
  before_texels_.bind(3);
}

void GpuNeighbors::run_neighbors(const BallBatch& batch, int pass) {
  ball_texels_.bind(0);
  cell_texels_.bind(1);
  bind_listed();
  class_counts_.bind(0);
  balls_low.bind(1);
  cell_first_.bind(2);
  ball_count_.bind(3);
  first.bind(4);
  pair_first.bind(5);
  relative.bind(6);
  labels.bind(7);
  const Program& program = kernel("reduced_surface/neighbors", pass);
  program.set(kernel::NeighborParameters{.first_entry = batch.first,
                                         .entry_count = batch.count,
                                         .largest_radius = largest_radius_,
                                         .capacity = static_cast<std::uint32_t>(labels.byte_count() / kWord)});
  program.set(grid_, kernel::kCellGridBinding);
  program.dispatch(group_count(batch.count));
}

bool GpuNeighbors::count_neighbors(BallBatch& batch) {
  resident_ = {};
  first.resize((batch.count + 1) * kWord);
  pair_first.resize((batch.count + 1) * kWord);
  class_counts_.resize(batch.count * kClasses * kWord);
  relative.resize(sizeof(glm::vec4));
  labels.resize(kWord);
  run_neighbors(batch, 0);
  scan_counts(batch);
  if (counting_ == Counting::later) return true;
  read_counts(batch);
  const std::size_t limit = query_gpu_limits().storage_block_bytes;
  if (batch.neighbor_count * sizeof(glm::vec4) <= limit) return true;
  if (batch.count == 1)
    throw CapacityError(
        message("ball {} overlaps {} others, more than this driver's storage blocks of {} MiB hold; use @device cpu@",
                batch.first + 1, batch.neighbor_count, limit >> 20));
  return false;
}

// Where the host does not read the counts first, places end at the available room.
void GpuNeighbors::scan_counts(BallBatch& batch) {
  if (counting_ == Counting::now) {
    scan_(first, batch.count);
    scan_(pair_first, batch.count);
    return;
  }
  const auto with_room = [](std::uint32_t count) { return count + count / 8 + 64; };
  trusted_ = batch;
  trusted_.neighbor_count = batch.neighbor_count = with_room(known_.neighbor_count);
  trusted_.pair_count = batch.pair_count = with_room(known_.pair_count);
  scan_(first, batch.count, batch.neighbor_count);
  scan_(pair_first, batch.count, batch.pair_count);
}

void GpuNeighbors::request_counts(Readback& readback) {
  readback.request(ball_count_, 0, {&counted_.cut_short, 1});
  readback.request(first, trusted_.count * kWord, {&counted_.neighbors, 1});
  readback.request(pair_first, trusted_.count * kWord, {&counted_.pairs, 1});
}

bool GpuNeighbors::take_counts() {
  known_ = {};
  if (counted_.cut_short != 0 || counted_.neighbors >= trusted_.neighbor_count || counted_.pairs >= trusted_.pair_count)
    return false;
  known_ = {0, trusted_.count, counted_.neighbors, counted_.pairs};
  return true;
}

void GpuNeighbors::read_counts(BallBatch& batch) {
  trusted_ = batch;
  Readback readback;
  request_counts(readback);
  readback.read();
  if (counted_.cut_short != 0)
    throw CapacityError(message(
        "an atom has more neighbours than this driver's kernels can process; use @device cpu@, or a smaller probe"));
  batch.neighbor_count = counted_.neighbors;
  batch.pair_count = counted_.pairs;
  known_ = batch.count == entry_count_ ? batch : BallBatch{};
}

void GpuNeighbors::list_neighbors(const BallBatch& batch) {
  relative.resize(std::max(1u, batch.neighbor_count) * sizeof(glm::vec4));
  labels.resize(std::max(1u, batch.neighbor_count) * kWord);
  run_neighbors(batch, 1);
}

void GpuNeighbors::list_pairs(const BallBatch& batch) {
  pairs.resize(std::max(1u, batch.pair_count) * sizeof(glm::uvec2));
  first.bind(0);
  labels.bind(1);
  pair_first.bind(2);
  pairs.bind(3);
  bind_listed();
  const Program& program = kernel("reduced_surface/pairs");
  program.set(kernel::PairParameters{.first_entry = batch.first, .entry_count = batch.count});
  program.dispatch(group_count(batch.count));
}

}  // namespace meniscus
