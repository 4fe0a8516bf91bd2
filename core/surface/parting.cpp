// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest points of two convex hulls of arcs by support points (Gilbert, Johnson & Keerthi 1988), and the
// plane half-way between them.
#include "core/surface/parting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/message.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr double kClearance = 1e-9;  // Å to either side: a thousand times the rounding of a position

/// The borders of some faces as a convex body.
class Hull {
 public:
  Hull(const Surface& surface, std::span<const std::uint32_t> faces) {
    for (const std::uint32_t f : faces)
      for_each_border(surface, surface.faces[f], [&](const Border& border) { arcs_.push_back(&border); });
  }

  bool empty() const { return arcs_.empty(); }

  /// Returns the farthest point of all arcs along a direction; it is exact, because each arc's is known in closed form.
  glm::dvec3 farthest(const glm::dvec3& direction) const {
    glm::dvec3 best(0.0);
    double most = -std::numeric_limits<double>::infinity();
    for (const Border* arc : arcs_) {
      const glm::dvec3 side = glm::cross(arc->axis, arc->start);
      double top = std::atan2(glm::dot(direction, side), glm::dot(direction, arc->start));
      if (top < 0) top += 2 * std::numbers::pi;
      for (const double t : {0.0, arc->sweep, std::min(top, arc->sweep)}) {
        const glm::dvec3 point = arc_point(*arc, t);
        if (const double reach = glm::dot(direction, point); reach > most) {
          most = reach;
          best = point;
        }
      }
    }
    return best;
  }

 private:
  std::vector<const Border*> arcs_;
};

/// Returns the point of the affine hull of some points that is nearest to the origin, if it is a combination of them
/// with positive weights; solves Gram's equations with pivoting.
std::optional<glm::dvec3> nearest_inside(std::span<const glm::dvec3> points) {
  const std::size_t count = points.size();
  // The unknowns are the weights and the multiplier of "weights sum to 1".
  std::array<std::array<double, 6>, 5> rows{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) rows[i][j] = glm::dot(points[i], points[j]);
    rows[i][count] = rows[count][i] = 1.0;
  }
  rows[count][count + 1] = 1.0;
  const std::size_t size = count + 1;
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < size; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
    if (rows[pivot][c] == 0.0) return std::nullopt;
    std::swap(rows[c], rows[pivot]);
    for (std::size_t r = 0; r < size; ++r) {
      if (r == c) continue;
      const double factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k <= size; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  glm::dvec3 nearest(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = rows[i][size] / rows[i][i];
    if (!(weight > 0.0)) return std::nullopt;
    nearest += weight * points[i];
  }
  return nearest;
}

/// Replaces a simplex of up to four points by its smallest face that contains its point nearest to the origin, and
/// returns that point. All faces are tried.
glm::dvec3 reduce(std::vector<glm::dvec3>& simplex) {
  std::vector<glm::dvec3> best{simplex.back()};
  glm::dvec3 nearest = simplex.back();
  for (unsigned mask = 1; mask < (1u << simplex.size()); ++mask) {
    std::vector<glm::dvec3> corners;
    for (std::size_t n = 0; n < simplex.size(); ++n)
      if (mask & (1u << n)) corners.push_back(simplex[n]);
    const std::optional<glm::dvec3> point = nearest_inside(corners);
    if (!point || glm::dot(*point, *point) >= glm::dot(nearest, nearest)) continue;
    nearest = *point;
    best = std::move(corners);
  }
  simplex = std::move(best);
  return nearest;
}

}  // namespace

std::optional<Plane> plane_between(const Surface& surface, std::span<const std::uint32_t> inside,
                                   std::span<const std::uint32_t> outside) {
  const Hull a(surface, inside), b(surface, outside);
  if (a.empty() || b.empty()) return std::nullopt;
  std::vector<glm::dvec3> simplex{a.farthest({1, 0, 0}) - b.farthest({1, 0, 0})};
  glm::dvec3 between = simplex.front();  // from b to a; its length decreases
  std::optional<Plane> best;
  double widest = kClearance;
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps; ++step) {
    const double length = glm::length(between);
    if (!(length > kClearance)) break;
    const glm::dvec3 normal = -between / length;  // from a to b
    const glm::dvec3 last_of_a = a.farthest(normal), first_of_b = b.farthest(-normal);
    const double low = glm::dot(normal, last_of_a), high = glm::dot(normal, first_of_b), gap = high - low;
    if (0.5 * gap > widest) {
      widest = 0.5 * gap;
      best = Plane{normal, 0.5 * (low + high)};
    }
    // The gap of the best plane is the distance of the hulls.
    if (length - gap <= 1e-3 * length) break;
    simplex.push_back(last_of_a - first_of_b);
    between = reduce(simplex);
    if (simplex.size() == 4) break;  // the origin is inside: the hulls intersect
  }
  return best;
}

namespace {

/// Returns planes that separate `faces` from every one of `others`; nothing if some cannot be separated. A plane that
/// separates several of them is listed once.
std::optional<std::vector<Plane>> planes_around(const Surface& surface, std::span<const std::uint32_t> faces,
                                                std::span<const std::uint32_t> others) {
  std::vector<Plane> planes;
  for (const std::uint32_t other : others) {
    const Hull hull(surface, std::span(&other, 1));
    const bool parted = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
      return glm::dot(plane.normal, hull.farthest(-plane.normal)) > plane.offset + kClearance;
    });
    if (parted) continue;
    const std::optional<Plane> plane = plane_between(surface, faces, std::span(&other, 1));
    if (!plane) return std::nullopt;
    planes.push_back(*plane);
  }
  return planes;
}

}  // namespace

std::vector<PartedFaces> part_faces(const Surface& surface, std::span<const std::uint32_t> kept,
                                    std::span<const std::uint32_t> dropped) {
  if (auto planes = planes_around(surface, kept, dropped)) return {{{kept.begin(), kept.end()}, std::move(*planes)}};
  std::vector<PartedFaces> parts;
  for (const std::uint32_t face : kept) {
    std::vector<std::uint32_t> others(dropped.begin(), dropped.end());
    std::copy_if(kept.begin(), kept.end(), std::back_inserter(others), [&](std::uint32_t k) { return k != face; });
    auto planes = planes_around(surface, std::span(&face, 1), others);
    if (!planes) {
      throw Error(
          message("one patch of the surface winds around another piece of itself, so that no plane separates them; "
                  "this part of the surface cannot be drawn alone (@cavities@, @by component@)"));
    }
    parts.push_back({{face}, std::move(*planes)});
  }
  return parts;
}

}  // namespace meniscus
