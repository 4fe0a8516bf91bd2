// SPDX-License-Identifier: BSD-3-Clause
// Divides atoms, computes one block after another, and those again in which ties have to be told apart.
#include "core/surface/blocks.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/base/stage_clock.h"
#include "core/math/box.h"
#include "core/surface/block_part.h"
#include "core/surface/block_patches.h"
#include "core/surface/block_sum.h"
#include "core/surface/measure.h"
#include "core/surface/reduced_surface_engine.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostAtOnce = 400'000;  // atoms whose tables are made together
constexpr std::size_t kMostInBlock = 150'000;
constexpr double kMostHalo = 1.7;  // of the atoms; with more work than that tables of all are made
constexpr double kHaloRoom = 0.1;  // Å for a probe of no size: far above what merged probes move, and radii grow by
constexpr std::size_t kMostOpen = 1000;  // atoms, in one attempt

double largest_radius(std::span<const Ball> atoms) {
  double largest = 0;
  for (const Ball& b : atoms) largest = std::max(largest, b.radius);
  return largest;
}

Box box_of(std::span<const Ball> atoms, std::span<const std::uint32_t> these) {
  Box box;
  for (const std::uint32_t a : these) box.include(atoms[a].center);
  return box;
}

void divide(std::span<const Ball> atoms, std::span<std::uint32_t> these, std::size_t parts,
            std::vector<std::vector<std::uint32_t>>& blocks) {
  if (parts <= 1) {
    blocks.emplace_back(these.begin(), these.end());
    std::ranges::sort(blocks.back());
    return;
  }
  const Box box = box_of(atoms, these);
  const glm::dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t first = parts / 2, middle = these.size() * first / parts;
  std::ranges::nth_element(these, these.begin() + static_cast<std::ptrdiff_t>(middle), {},
                           [&](std::uint32_t a) { return std::pair(atoms[a].center[axis], a); });
  divide(atoms, these.first(middle), first, blocks);
  divide(atoms, these.subspan(middle), parts - first, blocks);
}

// Computes all blocks, and again those in which radii have to grow.
class BlockRun {
 public:
  BlockRun(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
           double reach, ClipPlanes planes, StageClock& clock)
      : given_(atoms),
        atoms_(atoms.begin(), atoms.end()),
        p_(probe_radius),
        blocks_(blocks),
        reach_(reach),
        clock_(clock),
        origin_(middle_of(atoms)),
        block_of_(atoms.size()),
        parts_(blocks.size()),
        patches_(planes == ClipPlanes::listed ? blocks.size() : 0),
        is_due_(blocks.size(), 1) {
    for (std::uint32_t b = 0; b < blocks.size(); ++b)
      for (const std::uint32_t a : blocks[b]) block_of_[a] = b;
  }

  Surface run(int attempts) {
    for (;;) {
      Surface surface = compute();
      const bool closed = surface.certificate.closed;
      if (closed) surface.atoms = std::move(atoms_);
      surface.certificate.grown_by = tie_growth(most_attempt_);
      surface.certificate.exact_within += tie_growth(most_attempt_);
      if (closed || !grow_around(surface.certificate.open_atoms, attempts)) return surface;
    }
  }

 private:
  Surface compute() {
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      if (!is_due_[b]) continue;
      parts_[b] = compute(b);
      is_due_[b] = 0;
      if (parts_[b].open_atoms.empty()) continue;
      Surface open;
      open.certificate.open_atoms = parts_[b].open_atoms;
      return open;
    }
    const auto stage = clock_.stage("area and volume");
    Surface surface = sum_blocks(atoms_, p_, blocks_, block_of_, parts_);
    if (patches_.empty() || !surface.certificate.closed) return surface;
    parts_.assign(blocks_.size(), {});  // joining needs the memory
    is_due_.assign(blocks_.size(), 1);
    surface.certificate.open_atoms = join_patches(block_of_, patches_, surface);
    surface.certificate.closed = surface.certificate.open_atoms.empty();
    return surface;
  }

  BlockPart compute(std::uint32_t b) { return compute(blocks_[b], patches_.empty() ? nullptr : &patches_[b], clock_); }

  // own: rising.
  BlockPart compute(std::span<const std::uint32_t> own, BlockPatches* patches, StageClock& clock) const {
    const std::vector<std::uint32_t> number = with_halo(given_, own, reach_);
    std::vector<Ball> balls;
    std::vector<char> is_own;
    for (const std::uint32_t a : number) {
      balls.push_back(atoms_[a]);
      is_own.push_back(std::ranges::binary_search(own, a));
    }
    return compute_block(std::move(balls), number, std::move(is_own), p_, origin_, patches, clock);
  }

  // Radii of all atoms that may have to do with the open ones. False: they have grown as often as they may, or those
  // that are open are too many for a tie.
  bool grow_around(std::span<const std::uint32_t> open, int attempts) {
    if (open.size() > kMostOpen) return false;
    std::vector<std::uint32_t> grown;
    int attempt = 0;
    for (std::uint32_t a = 0; a < given_.size(); ++a) {
      const bool is_near = std::ranges::any_of(open, [&](std::uint32_t o) {
        const glm::dvec3 d = given_[o].center - given_[a].center;
        return glm::dot(d, d) <= reach_ * reach_;
      });
      if (!is_near) continue;
      grown.push_back(a);
      if (const auto known = attempt_of_.find(a); known != attempt_of_.end())
        attempt = std::max(attempt, known->second);
    }
    if (++attempt >= attempts) return false;
    attempt = first_that_closes(grown, attempt, attempts);
    most_attempt_ = std::max(most_attempt_, attempt);
    grow(grown, attempt);
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      const Box box = box_of(given_, blocks_[b]);
      const auto is_in = [&](std::uint32_t a) { return box.squared_distance(given_[a].center) <= reach_ * reach_; };
      if (std::ranges::any_of(grown, is_in)) is_due_[b] = 1;
    }
    return true;
  }

  void grow(std::span<const std::uint32_t> these, int attempt) {
    for (const std::uint32_t a : these) {
      attempt_of_[a] = attempt;
      atoms_[a].radius = grown_radius(given_[a].radius, a, attempt);
    }
  }

  // The attempt that a small block of those atoms alone asks for, so that large ones are computed again but once; the
  // first, if none closes it.
  int first_that_closes(std::span<const std::uint32_t> these, int first, int attempts) {
    StageClock unused;
    for (int attempt = first; attempt < attempts; ++attempt) {
      grow(these, attempt);
      if (compute(these, nullptr, unused).open_atoms.empty()) return attempt;
    }
    return first;
  }

  std::span<const Ball> given_;
  std::vector<Ball> atoms_;  // with radii that have grown
  double p_;
  std::span<const std::vector<std::uint32_t>> blocks_;
  double reach_;
  StageClock& clock_;
  glm::dvec3 origin_;
  std::vector<std::uint32_t> block_of_;
  std::vector<BlockPart> parts_;
  std::vector<BlockPatches> patches_;  // by block, if they are wanted
  std::vector<char> is_due_;
  std::unordered_map<std::uint32_t, int> attempt_of_;  // of atoms whose radii have grown
  int most_attempt_ = 0;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> divide_into_blocks(std::span<const Ball> atoms, std::size_t most) {
  std::vector<std::uint32_t> all(atoms.size());
  for (std::uint32_t a = 0; a < all.size(); ++a) all[a] = a;
  std::vector<std::vector<std::uint32_t>> blocks;
  divide(atoms, all, (atoms.size() + most - 1) / most, blocks);
  return blocks;
}

double halo_reach(std::span<const Ball> atoms, double probe_radius) {
  return 2 * largest_radius(atoms) + 4 * probe_radius + kHaloRoom * (1 + probe_radius);
}

std::vector<std::uint32_t> with_halo(std::span<const Ball> atoms, std::span<const std::uint32_t> block, double reach) {
  const Box box = box_of(atoms, block);
  std::vector<std::uint32_t> larger;
  for (std::uint32_t a = 0; a < atoms.size(); ++a)
    if (box.squared_distance(atoms[a].center) <= reach * reach) larger.push_back(a);
  return larger;
}

Surface surface_in_blocks(std::span<const Ball> atoms, double probe_radius,
                          std::span<const std::vector<std::uint32_t>> blocks, double reach, ClipPlanes planes,
                          StageClock& clock, int attempts) {
  return BlockRun(atoms, probe_radius, blocks, reach, planes, clock).run(attempts);
}

Surface compute_without_borders(std::span<const Ball> atoms, double probe_radius, ClipPlanes planes,
                                StageClock& clock) {
  if (atoms.size() > kMostAtOnce) {
    const std::vector<std::vector<std::uint32_t>> blocks = divide_into_blocks(atoms, kMostInBlock);
    const double reach = halo_reach(atoms, probe_radius);
    std::size_t computed = 0;
    for (const std::vector<std::uint32_t>& block : blocks) computed += with_halo(atoms, block, reach).size();
    if (static_cast<double>(computed) <= kMostHalo * static_cast<double>(atoms.size()))
      return surface_in_blocks(atoms, probe_radius, blocks, reach, planes, clock);
  }
  return compute_surface(*make_cpu_engine(), atoms, probe_radius, clock, planes);
}

}  // namespace meniscus
