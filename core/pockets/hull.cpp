// SPDX-License-Identifier: BSD-3-Clause
// Builds the filled solid of a large probe, places large probes on it, and finds the cells for a small probe in it.
#include "core/pockets/hull.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/parallel_for.h>

#include "core/math/ball.h"
#include "core/math/spiral.h"
#include "core/queries/surface_parts.h"
#include "core/surface/primitives.h"

namespace meniscus {

Hull::Hull(Surface surface) : whole_(std::move(surface)), anywhere_(whole_) {
  const std::vector<bool> reached = reached_from_outside(whole_);
  for (std::size_t c = 0; c < reached.size(); ++c)
    if (reached[c]) volume_ += whole_.components[c].volume;
  if (std::ranges::find(reached, false) == reached.end()) return;
  part_ = part_of(whole_, reached).surface;
  outside_.emplace(*part_);
}

// If a probe may be at the point, it gets to the nearest place where it touches an atom without leaving such places. If
// that is not a place of the outside, the point lies in a cavity.
double Hull::to_probe(const glm::dvec3& point) const {
  const bool in_sas = anywhere_.in_sas(point);
  if (!outside_) return in_sas ? anywhere_.to_probe(point) : 0.0;
  const double outside = outside_->to_probe(point);
  return in_sas || anywhere_.to_probe(point) < outside ? outside : 0.0;
}

namespace {

/// Adds the wanted centres of fixed probes.
void add_fixed(const Surface& s, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ConcavePatch& patch : s.concave)
    if (wanted(patch.center, 0.0)) places.push_back(patch.center);
}

/// Adds wanted places along arcs, at most `step` (Å) apart.
void add_on_arcs(const Surface& s, double step, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ToroidalPatch& t : s.toroidal) {
    if (!wanted(t.center, t.radius)) continue;
    const auto count = static_cast<std::size_t>(std::ceil(t.sweep * t.radius / step));
    const glm::dvec3 across = glm::cross(t.axis, t.start);
    for (std::size_t n = t.free() ? 0 : 1; n < count; ++n) {
      const double angle = t.sweep * static_cast<double>(n) / static_cast<double>(count);
      const glm::dvec3 place = t.center + t.radius * (std::cos(angle) * t.start + std::sin(angle) * across);
      if (wanted(place, 0.0)) places.push_back(place);
    }
  }
}

/// Returns the first direction of a spiral of `count` directions that may lie above a height over a sphere's centre;
/// all later ones are higher.
std::size_t first_above(double height, double radius, std::size_t count) {
  const double n = 0.5 * (height / radius + 1.0) * static_cast<double>(count) - 2.0;  // one more, for rounding
  return n <= 0.0 ? 0 : n >= static_cast<double>(count) ? count : static_cast<std::size_t>(n);
}

/// Adds wanted places on the faces of the SAS.
void add_on_faces(const Surface& s, const PlaceSteps& steps, const Box& bounds, const NearWanted& wanted,
                  std::vector<glm::dvec3>& places) {
  for (const ConvexPatch& patch : s.convex) {
    const Ball& atom = s.atoms[patch.atom];
    const double radius = atom.radius + s.probe_radius;
    if (!wanted(atom.center, radius)) continue;
    const double step = steps.on_sphere(atom.radius);
    const std::span<const Plane> planes(s.planes.data() + patch.first_plane, patch.plane_count);
    const auto count = static_cast<std::size_t>(std::ceil(4 * std::numbers::pi * std::pow(radius / step, 2)));
    // The sphere of an atom far larger than others has far more places than are wanted.
    const std::size_t end = std::min(count, first_above(bounds.high.z - atom.center.z, radius, count) + 4);
    for (std::size_t n = first_above(bounds.low.z - atom.center.z, radius, count); n < end; ++n) {
      const glm::dvec3 direction = spiral_direction(n, count), foot = atom.center + atom.radius * direction;
      if (std::ranges::all_of(planes,
                              [&](const Plane& plane) { return glm::dot(plane.normal, foot) <= plane.offset; }) &&
          wanted(atom.center + radius * direction, 0.0))
        places.push_back(atom.center + radius * direction);
    }
  }
}

/// Returns the places without those that coincide with an earlier one.
std::vector<glm::dvec3> without_doubles(const std::vector<glm::dvec3>& places) {
  const BallGrid grid(places, 1.0);
  std::vector<bool> kept(places.size(), true);
  std::vector<glm::dvec3> result;
  for (std::uint32_t n = 0; n < places.size(); ++n) {
    grid.for_each_near(places[n], kSamePlace, [&](std::uint32_t m) { kept[n] = kept[n] && (m >= n || !kept[m]); });
    if (kept[n]) result.push_back(places[n]);
  }
  return result;
}

}  // namespace

std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted) {
  std::vector<glm::dvec3> places;
  add_fixed(surface, wanted, places);
  add_on_arcs(surface, steps.on_arcs, wanted, places);
  add_on_faces(surface, steps, bounds, wanted, places);
  return without_doubles(places);
}

namespace {

constexpr double kFinest = 0.25, kCoarsest = 2.0;  // Å, half edges of cells and of the cubes that they come from
constexpr int kRegion = 8;                         // coarsest cubes along an edge of a region
constexpr double kRounding = 1e-6;                 // Å, far above the rounding error of coordinates

/// A cube, and the atoms that matter within it.
struct Region {
  glm::dvec3 middle;
  double half;
  std::vector<std::uint32_t> near;

  double reach() const { return half * std::numbers::sqrt3; }  // Å, from the middle to a corner
};

/// Finds the cells by dividing cubes.
class CellFinder {
 public:
  CellFinder(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
      : atoms_(atoms), hull_(hull), clearance_(clearance), probe_radius_(probe_radius) {}

  std::vector<Box> run() const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Ball& atom : atoms_) {
      low = glm::min(low, atom.center);
      high = glm::max(high, atom.center);
    }
    // The hull is no larger than the convex hull of the balls.
    low -= largest_radius();
    const glm::ivec3 size = glm::ivec3(glm::ceil((high + largest_radius() - low) / (2 * kCoarsest)));
    int edge = kRegion;
    while (edge < std::max({size.x, size.y, size.z})) edge *= 2;
    std::vector<std::uint32_t> all(atoms_.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<CubeRange> regions;
    divide({low, glm::ivec3(0), size}, edge, all, regions);
    std::vector<std::vector<Box>> found(regions.size());
    tbb::parallel_for(std::size_t{0}, regions.size(),
                      [&](std::size_t n) { visit_cubes(regions[n], kRegion, regions[n].near, found[n]); });
    std::vector<Box> boxes;
    for (const std::vector<Box>& some : found) boxes.insert(boxes.end(), some.begin(), some.end());
    return boxes;
  }

 private:
  /// A range of cubes of half edge kCoarsest, counted from the low corner of the searched space.
  struct CubeRange {
    glm::dvec3 low;
    glm::ivec3 first, size;  // the first cube of the range; the number of cubes in all
    std::vector<std::uint32_t> near = {};

    glm::dvec3 middle(const glm::dvec3& cubes) const { return low + 2 * kCoarsest * (glm::dvec3(first) + cubes); }
  };

  /// Returns eighth n of a range with `edge` cubes along each axis.
  static CubeRange eighth_of(const CubeRange& corner, int edge, int n) {
    return {corner.low, corner.first + edge / 2 * glm::ivec3(n & 1, n >> 1 & 1, n >> 2), corner.size};
  }

  /// Returns the largest SAS radius (Å).
  double largest_radius() const {
    double radius = 0.0;
    for (const Ball& atom : atoms_) radius = std::max(radius, atom.radius);
    return radius + probe_radius_;
  }

  /// Divides a range into regions in which there may be cells, with the atoms near them. A ball far larger than others
  /// makes the space so large that most of it must be left out as a whole.
  void divide(const CubeRange& corner, int edge, std::span<const std::uint32_t> near,
              std::vector<CubeRange>& regions) const {
    if (glm::any(glm::greaterThanEqual(corner.first, corner.size))) return;
    const Region region = region_of(near, corner, edge, 2 * hull_.surface().probe_radius);
    if (holds_no_cell(region)) return;
    if (edge == kRegion) {
      regions.push_back(corner);
      regions.back().near = region.near;
      return;
    }
    for (int n = 0; n < 8; ++n) divide(eighth_of(corner, edge, n), edge / 2, region.near, regions);
  }

  /// Returns the region of a range with `edge` cubes along each axis, with the atoms that are no farther than `away`
  /// from it.
  Region region_of(std::span<const std::uint32_t> atoms, const CubeRange& corner, int edge, double away) const {
    Region region{corner.middle(glm::dvec3(0.5 * edge)), kCoarsest * edge, {}};
    const double far = region.reach() + away + kRounding;
    std::ranges::copy_if(atoms, std::back_inserter(region.near), [&](std::uint32_t a) {
      return glm::distance(region.middle, atoms_[a].center) < atoms_[a].radius + far;
    });
    return region;
  }

  /// True if visit() would certainly find nothing in a region, for a reason that holds in all of it.
  bool holds_no_cell(const Region& region) const {
    const double reach = region.reach() + kRounding;
    for (const std::uint32_t a : region.near)
      if (glm::distance(region.middle, atoms_[a].center) < atoms_[a].radius + probe_radius_ - reach) return true;
    // If only one atom is near, a small probe that touches no atom is no farther from a large probe on that atom than
    // the difference of their radii; if no atom is near, its distance from a large one is 0. Cells extend farther by
    // the finest's diagonal.
    const double large = hull_.surface().probe_radius;
    return region.near.size() <= 1 && !hull_.has_cavities() &&
           large - probe_radius_ + 2 * kFinest * std::numbers::sqrt3 + kRounding < clearance_;
  }

  /// Visits the cubes of a range with `edge` cubes along each axis.
  void visit_cubes(const CubeRange& corner, int edge, std::span<const std::uint32_t> near,
                   std::vector<Box>& found) const {
    if (glm::any(glm::greaterThanEqual(corner.first, corner.size))) return;
    const Region region = region_of(near, corner, edge, probe_radius_);
    if (edge == 1) return visit(region, found);
    for (int n = 0; n < 8; ++n) visit_cubes(eighth_of(corner, edge, n), edge / 2, region.near, found);
  }

  /// Adds the cells of a cube, which is divided if only a part of it may belong to cells.
  void visit(const Region& cube, std::vector<Box>& found) const {
    const double reach = cube.reach();
    if (is_in_one_ball(cube)) return;
    const double away = hull_.to_probe(cube.middle);
    if (away < clearance_ - reach) return;
    if (cube.half <= kFinest || (away >= clearance_ + reach && is_in_no_ball(cube))) {
      found.push_back({cube.middle - cube.half, cube.middle + cube.half});
      return;
    }
    for (int corner = 0; corner < 8; ++corner)
      visit({cube.middle + 0.5 * cube.half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1),
             0.5 * cube.half, cube.near},
            found);
  }

  /// True if one grown ball covers the cube.
  bool is_in_one_ball(const Region& cube) const {
    return std::ranges::any_of(cube.near, [&](std::uint32_t a) {
      return glm::distance(cube.middle, atoms_[a].center) < atoms_[a].radius + probe_radius_ - cube.reach();
    });
  }

  /// True if no grown ball meets the cube.
  bool is_in_no_ball(const Region& cube) const {
    return std::ranges::all_of(cube.near, [&](std::uint32_t a) {
      return glm::distance(cube.middle, atoms_[a].center) > atoms_[a].radius + probe_radius_ + cube.reach();
    });
  }

  std::span<const Ball> atoms_;
  const Hull& hull_;
  double clearance_, probe_radius_;
};

}  // namespace

ProbeCells::ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
    : boxes_(CellFinder(atoms, probe_radius, hull, clearance).run()), tree_(boxes_) {}

Box ProbeCells::bounds(double reach) const {
  Box all = boxes_.front();
  for (const Box& box : boxes_) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  return {all.low - reach, all.high + reach};
}

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
