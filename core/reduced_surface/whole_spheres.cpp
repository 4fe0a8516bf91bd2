// SPDX-License-Identifier: BSD-3-Clause
// Tests points of spheres without arcs against the balls around them, nearest cells first.
#include "core/reduced_surface/whole_spheres.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball_grid.h"
#include "core/math/double_geometry.h"
#include "core/math/quad_geometry.h"

namespace meniscus {
namespace {

// Directions off the axes and planes in which models are symmetric; each is used with its opposite.
constexpr std::array<glm::dvec3, 3> kDirections{{{0.36, 0.48, 0.8}, {0.8, -0.6, 0.0}, {0.48, 0.64, -0.6}}};

// A bound, in roundings of the terms, on the error of a power or of a gap between squared lengths: centres are rounded
// once by their difference, radii by a root, directions by less than two units.
constexpr double kRoundings = 32 * geometry::kUnitRoundoff;

enum class Exposure { exposed, covered, doubtful };

class WholeSpheres {
 public:
  WholeSpheres(std::span<const Ball> atoms, double largest_radius, std::span<const double> weights,
               const std::vector<bool>& swallowed)
      : atoms_(atoms),
        weights_(weights),
        swallowed_(swallowed),
        largest_radius_(largest_radius),
        grid_(atoms, largest_radius) {}

  enum class Kind { buried, lone, lost };

  Kind kind_of(std::uint32_t a) const {
    bool exposed = false, covered = false;
    for (const glm::dvec3& direction : kDirections) {
      for (const Exposure point : {look(a, direction), look(a, -direction)}) {
        exposed = exposed || point == Exposure::exposed;
        covered = covered || point == Exposure::covered;
      }
      if (exposed || covered) break;
    }
    if (!exposed) return covered ? Kind::buried : Kind::lost;
    return covered || meets_another(a) ? Kind::lost : Kind::lone;
  }

 private:
  // Decides how ball b covers the point `step` from the centre of a, by the sign of its power.
  Exposure under(std::uint32_t b, std::uint32_t a, const glm::dvec3& step) const {
    const glm::dvec3 d = atoms_[b].center - atoms_[a].center;
    const double square = glm::dot(d, d), weights = weights_[a] + weights_[b];
    if (square > 4 * weights) return Exposure::exposed;
    const double power = weights_[a] + square - weights_[b] - 2 * glm::dot(step, d);
    const double error = kRoundings * (weights + square);
    if (power > error) return Exposure::exposed;
    return power < -error ? Exposure::covered : Exposure::doubtful;
  }

  // Tests the point of the sphere in this direction. The ball that covers it is near, as a rule, so the nearest cells
  // come first.
  Exposure look(std::uint32_t a, const glm::dvec3& direction) const {
    const glm::dvec3 step = std::sqrt(weights_[a]) * direction, point = atoms_[a].center + step;
    bool covered = false, doubtful = false;
    for (const double part : {0.3, 1.0}) {
      grid_.for_each_row_near(point, part * largest_radius_, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t n = first; n < last && !covered; ++n) {
          const std::uint32_t b = grid_.order()[n];
          if (b == a || swallowed_[b]) continue;
          const Exposure found = under(b, a, step);
          covered = found == Exposure::covered;
          doubtful = doubtful || found == Exposure::doubtful;
        }
      });
      if (covered) return Exposure::covered;
    }
    return doubtful ? Exposure::doubtful : Exposure::exposed;
  }

  // True by the sign that decides whether two spheres have a circle at all.
  bool meets_another(std::uint32_t a) const {
    bool meets = false;
    const double radius = std::sqrt(weights_[a]);
    grid_.for_each_near(atoms_[a].center, radius + largest_radius_, [&](std::uint32_t b) {
      if (meets || b == a || swallowed_[b]) return;
      const glm::dvec3 d = atoms_[b].center - atoms_[a].center;
      const double sum = radius + std::sqrt(weights_[b]), gap = glm::dot(d, d) - sum * sum;
      if (std::abs(gap) > kRoundings * sum * sum) {
        meets = gap < 0;
        return;
      }
      const auto circle = quad_geometry::circle_of_two_spheres({d.x, d.y, d.z}, weights_[a], weights_[b]);
      meets = circle.radius_squared > 0;
    });
    return meets;
  }

  std::span<const Ball> atoms_;
  std::span<const double> weights_;
  const std::vector<bool>& swallowed_;
  double largest_radius_;
  BallGrid grid_;
};

std::vector<std::uint32_t> atoms_without_arcs(const std::vector<bool>& swallowed, std::span<const RsArc> arcs) {
  std::vector<char> settled(swallowed.begin(), swallowed.end());
  for (const RsArc& arc : arcs) settled[arc.i] = settled[arc.j] = 1;
  std::vector<std::uint32_t> left;
  for (std::uint32_t a = 0; a < settled.size(); ++a)
    if (!settled[a]) left.push_back(a);
  return left;
}

}  // namespace

void find_whole_spheres(std::span<const Ball> atoms, std::span<const double> weights,
                        const std::vector<bool>& swallowed, ReducedSurface& rs) {
  rs.lone_atoms.clear();
  rs.lost_atoms.clear();
  const std::vector<std::uint32_t> asked = atoms_without_arcs(swallowed, rs.arcs);
  if (asked.empty()) return;
  const WholeSpheres spheres(atoms, std::sqrt(*std::ranges::max_element(weights)), weights, swallowed);
  std::vector<WholeSpheres::Kind> kinds(asked.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked.size(), 256), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) kinds[n] = spheres.kind_of(asked[n]);
  });
  for (std::size_t n = 0; n < asked.size(); ++n) {
    if (kinds[n] == WholeSpheres::Kind::lone) rs.lone_atoms.push_back(asked[n]);
    if (kinds[n] == WholeSpheres::Kind::lost) rs.lost_atoms.push_back(asked[n]);
  }
}

}  // namespace meniscus
