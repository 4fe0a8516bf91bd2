// SPDX-License-Identifier: BSD-3-Clause
// Drops cubes whose every point is inside one grown ball, or too near to the large probe.
#include "core/pockets/probe_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/math/ball_grid.h"

namespace meniscus {
namespace {

constexpr double kFinest = 0.25, kCoarsest = 2.0;  // Å, half edges of cells and of the cubes that they come from

class CellFinder {
 public:
  CellFinder(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
      : atoms_(atoms), hull_(hull), clearance_(clearance), probe_radius_(probe_radius), balls_(atoms, largest()) {}

  std::vector<Box> run() const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Ball& atom : atoms_) {
      low = glm::min(low, atom.center);
      high = glm::max(high, atom.center);
    }
    // The hull is no larger than the convex hull of the balls.
    low -= largest();
    const glm::ivec3 size = glm::ivec3(glm::ceil((high + largest() - low) / (2 * kCoarsest)));
    std::vector<std::vector<Box>> slabs(static_cast<std::size_t>(size.z) * size.y);
    tbb::parallel_for(std::size_t{0}, slabs.size(), [&](std::size_t slab) {
      const int y = static_cast<int>(slab) % size.y, z = static_cast<int>(slab) / size.y;
      for (int x = 0; x < size.x; ++x) visit(low + 2 * kCoarsest * (glm::dvec3(x, y, z) + 0.5), kCoarsest, slabs[slab]);
    });
    std::vector<Box> boxes;
    for (const std::vector<Box>& slab : slabs) boxes.insert(boxes.end(), slab.begin(), slab.end());
    return boxes;
  }

 private:
  double largest() const {
    double radius = 0.0;
    for (const Ball& atom : atoms_) radius = std::max(radius, atom.radius);
    return radius + probe_radius_;
  }

  void visit(const glm::dvec3& middle, double half, std::vector<Box>& found) const {
    const double reach = half * std::numbers::sqrt3;  // of its corners
    if (in_one_ball(middle, reach)) return;
    const double away = hull_.to_probe(middle);
    if (away < clearance_ - reach) return;
    if (half <= kFinest || (away >= clearance_ + reach && in_no_ball(middle, reach))) {
      found.push_back({middle - half, middle + half});
      return;
    }
    for (int corner = 0; corner < 8; ++corner)
      visit(middle + 0.5 * half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1), 0.5 * half,
            found);
  }

  bool in_one_ball(const glm::dvec3& middle, double reach) const {
    bool inside = false;
    if (largest_ <= reach) return false;
    balls_.for_each_near(middle, largest_ - reach, [&](std::uint32_t a) {
      inside = inside || glm::distance(middle, atoms_[a].center) < atoms_[a].radius + probe_radius_ - reach;
    });
    return inside;
  }

  bool in_no_ball(const glm::dvec3& middle, double reach) const {
    bool clear = true;
    balls_.for_each_near(middle, largest_ + reach, [&](std::uint32_t a) {
      clear = clear && glm::distance(middle, atoms_[a].center) > atoms_[a].radius + probe_radius_ + reach;
    });
    return clear;
  }

  std::span<const Ball> atoms_;
  const Hull& hull_;
  double clearance_, probe_radius_;
  double largest_ = largest();
  BallGrid balls_;
};

}  // namespace

ProbeCells::ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
    : boxes_(CellFinder(atoms, probe_radius, hull, clearance).run()), tree_(boxes_) {}

bool ProbeCells::within(const glm::dvec3& point, double reach) const {
  bool found = false;
  // The tree leaves out what is as far as its limit.
  tree_.nearest(point, reach + 1.0, [&](std::uint32_t n, double wanted) {
    found = found || boxes_[n].squared_distance(point) <= reach * reach;
    return found ? 0.0 : wanted;
  });
  return found;
}

}  // namespace meniscus
