// SPDX-License-Identifier: BSD-3-Clause
// Brute-force distance to the accessible region and sphere tracing of it.
#include "tests/support/sphere_tracer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace meniscus::testing {
namespace {

// A candidate this little inside a ball still counts as exposed: points where four or more spheres meet lie on all of
// them only up to rounding.
constexpr double kTie = 1e-9;

glm::dvec3 any_perpendicular(const glm::dvec3& n) {
  const glm::dvec3 a = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, a));
}

// Returns the point of a circle nearest to x. On the axis all points are, but for rounding.
glm::dvec3 nearest_on_circle(const glm::dvec3& x, const glm::dvec3& center, const glm::dvec3& axis, double radius) {
  constexpr double kOnAxis = 1e-12;  // Å
  glm::dvec3 across = x - center;
  // Twice: near the axis the first step leaves a part along it that is not small compared with the part across.
  for (int n = 0; n < 2; ++n) across -= glm::dot(across, axis) * axis;
  const double length = glm::length(across);
  return center + radius * (length > kOnAxis ? across / length : any_perpendicular(axis));
}

}  // namespace

SphereTracer::SphereTracer(std::span<const Ball> balls, double probe_radius, double margin)
    : probe_radius_(probe_radius), reach_(probe_radius + margin) {
  for (const Ball& b : balls) spheres_.push_back({b.center, b.radius + probe_radius});
  find_blockers();
  for (std::uint32_t i = 0; i < spheres_.size(); ++i)
    for (std::uint32_t n = 0; n < spheres_[i].blocker_count; ++n)
      if (const std::uint32_t j = sphere_blockers_[spheres_[i].first_blocker + n]; j > i) find_circle(i, j);
  find_exposed_spheres();
  build_grid();
}

// Finds pairs of overlapping balls by a sweep along x.
void SphereTracer::find_blockers() {
  std::vector<std::uint32_t> order(spheres_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return spheres_[a].center.x < spheres_[b].center.x; });
  double largest = 0.0;
  for (const Sphere& s : spheres_) largest = std::max(largest, s.radius);
  std::vector<std::vector<std::uint32_t>> overlapping(spheres_.size());
  for (std::size_t a = 0; a < order.size(); ++a) {
    const Sphere& s = spheres_[order[a]];
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const Sphere& o = spheres_[order[b]];
      if (o.center.x - s.center.x > s.radius + largest) break;
      if (glm::distance(s.center, o.center) >= s.radius + o.radius) continue;
      overlapping[order[a]].push_back(order[b]);
      overlapping[order[b]].push_back(order[a]);
    }
  }
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    std::sort(overlapping[i].begin(), overlapping[i].end());
    spheres_[i].first_blocker = static_cast<std::uint32_t>(sphere_blockers_.size());
    spheres_[i].blocker_count = static_cast<std::uint32_t>(overlapping[i].size());
    sphere_blockers_.insert(sphere_blockers_.end(), overlapping[i].begin(), overlapping[i].end());
  }
}

bool SphereTracer::covered(const glm::dvec3& x, std::span<const std::uint32_t> blockers, std::uint32_t skip_a,
                           std::uint32_t skip_b) const {
  for (const std::uint32_t k : blockers) {
    if (k == skip_a || k == skip_b) continue;
    const double r = spheres_[k].radius - kTie;
    const glm::dvec3 d = x - spheres_[k].center;
    if (r > 0.0 && glm::dot(d, d) < r * r) return true;
  }
  return false;
}

// Keeps the circle of spheres i and j if part of it is exposed, and its exposed meetings with later spheres.
void SphereTracer::find_circle(std::uint32_t i, std::uint32_t j) {
  const Sphere &a = spheres_[i], &b = spheres_[j];
  const glm::dvec3 between = b.center - a.center;
  const double distance = glm::length(between);
  if (!(distance > 0.0)) return;
  const double along = 0.5 * (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance);
  const double squared = (a.radius - along) * (a.radius + along);
  if (!(squared > 0.0)) return;
  Circle c{a.center + between * (along / distance), between / distance, std::sqrt(squared), {i, j}};

  struct Crossing {
    std::uint32_t sphere;
    glm::dvec3 point;
  };
  std::vector<std::uint32_t> blockers;
  std::vector<Crossing> crossings;
  for (std::uint32_t n = 0; n < a.blocker_count; ++n) {
    const std::uint32_t k = sphere_blockers_[a.first_blocker + n];
    if (k == j) continue;
    // |m + T(cos, sin) - c_k| < R_k  <=>  T |w| cos(angle to w) > q, with w = the part of c_k - m in the circle's
    // plane.
    const glm::dvec3 to_k = spheres_[k].center - c.center;
    const glm::dvec3 w = to_k - glm::dot(to_k, c.axis) * c.axis;
    const double q = 0.5 * (glm::dot(to_k, to_k) + squared - spheres_[k].radius * spheres_[k].radius);
    // A ball on the circle's own axis covers all of it or nothing; all three spheres may share the circle.
    if (glm::length(w) < kTie) {
      if (q < -kTie) return;
      continue;
    }
    const double reach = c.radius * glm::length(w);
    if (q >= reach) continue;
    if (q < -reach) return;
    blockers.push_back(k);
    const double cosine = q / reach, sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const glm::dvec3 u = glm::normalize(w), v = glm::cross(c.axis, u);
    for (const double sign : {-1.0, 1.0})
      crossings.push_back({k, c.center + c.radius * (cosine * u + sign * sine * v)});
  }

  bool exposed = false;
  for (const Crossing& x : crossings) {
    if (covered(x.point, blockers, x.sphere, x.sphere)) continue;
    exposed = true;
    if (x.sphere > j) vertices_.push_back({x.point, {i, j, x.sphere}});
  }
  if (crossings.empty()) exposed = true;
  if (!exposed) return;
  c.first_blocker = static_cast<std::uint32_t>(circle_blockers_.size());
  c.blocker_count = static_cast<std::uint32_t>(blockers.size());
  circle_blockers_.insert(circle_blockers_.end(), blockers.begin(), blockers.end());
  circles_.push_back(c);
}

// The border of a partly exposed sphere consists of exposed circle arcs; otherwise one point speaks for all.
void SphereTracer::find_exposed_spheres() {
  for (const Circle& c : circles_) spheres_[c.atom[0]].exposed = spheres_[c.atom[1]].exposed = true;
  for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
    Sphere& s = spheres_[i];
    const std::span blockers(sphere_blockers_.data() + s.first_blocker, s.blocker_count);
    if (!s.exposed) s.exposed = !covered(s.center + glm::dvec3(0, 0, s.radius), blockers, i, i);
  }
}

std::span<const std::uint32_t> SphereTracer::CellList::at(std::size_t cell) const {
  return {item.data() + first[cell], first[cell + 1] - first[cell]};
}

template <class Visit>
void SphereTracer::visit_cells(const glm::dvec3& low, const glm::dvec3& high, Visit visit) const {
  const glm::ivec3 from = glm::max(glm::ivec3(glm::floor((low - grid_low_) / cell_size_)), glm::ivec3(0));
  const glm::ivec3 to = glm::min(glm::ivec3(glm::floor((high - grid_low_) / cell_size_)), cells_ - 1);
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) visit(glm::ivec3(x, y, z));
}

// extent(item) returns {centre, half width}, and distance(item, point) the distance of the point from the item.
SphereTracer::CellList SphereTracer::fill_cells(std::size_t count, const auto& extent, const auto& distance) const {
  const double half_diagonal = 0.5 * std::sqrt(3.0) * cell_size_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cell_and_item;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [center, half] = extent(i);
    visit_cells(center - (half + reach_), center + (half + reach_), [&](const glm::ivec3& c) {
      const glm::dvec3 middle = grid_low_ + cell_size_ * (glm::dvec3(c) + 0.5);
      if (distance(i, middle) > reach_ + half_diagonal) return;
      cell_and_item.emplace_back((c.z * cells_.y + c.y) * cells_.x + c.x, i);
    });
  }
  CellList list;
  list.first.assign(static_cast<std::size_t>(cells_.x) * cells_.y * cells_.z + 1, 0);
  for (const auto& [cell, item] : cell_and_item) ++list.first[cell + 1];
  std::partial_sum(list.first.begin(), list.first.end(), list.first.begin());
  list.item.resize(cell_and_item.size());
  std::vector<std::uint32_t> next = list.first;
  for (const auto& [cell, item] : cell_and_item) list.item[next[cell]++] = item;
  return list;
}

void SphereTracer::build_grid() {
  glm::dvec3 low(1e300), high(-1e300);
  for (const Sphere& s : spheres_) {
    low = glm::min(low, s.center - (s.radius + reach_));
    high = glm::max(high, s.center + (s.radius + reach_));
  }
  if (spheres_.empty()) low = high = glm::dvec3(0.0);
  const glm::dvec3 size = high - low;
  // A large reach gives neighbouring cells the same items; smaller cells would only repeat them more often.
  cell_size_ = std::max({1.0, reach_ / 8, std::cbrt(size.x * size.y * size.z / 4e6)});
  grid_low_ = low;
  cells_ = glm::ivec3(glm::floor(size / cell_size_)) + 1;
  sphere_cells_ = fill_cells(
      spheres_.size(), [&](auto i) { return std::pair(spheres_[i].center, spheres_[i].radius); },
      [&](auto i, const glm::dvec3& x) { return glm::distance(x, spheres_[i].center) - spheres_[i].radius; });
  circle_cells_ = fill_cells(
      circles_.size(), [&](auto i) { return std::pair(circles_[i].center, circles_[i].radius); },
      [&](auto i, const glm::dvec3& x) {
        return glm::distance(x, nearest_on_circle(x, circles_[i].center, circles_[i].axis, circles_[i].radius));
      });
  vertex_cells_ = fill_cells(
      vertices_.size(), [&](auto i) { return std::pair(vertices_[i].center, 0.0); },
      [&](auto i, const glm::dvec3& x) { return glm::distance(x, vertices_[i].center); });
}

std::optional<std::size_t> SphereTracer::cell_of(const glm::dvec3& x) const {
  const glm::ivec3 c(glm::floor((x - grid_low_) / cell_size_));
  if (c.x < 0 || c.y < 0 || c.z < 0 || c.x >= cells_.x || c.y >= cells_.y || c.z >= cells_.z) return std::nullopt;
  return (static_cast<std::size_t>(c.z) * cells_.y + c.y) * cells_.x + c.x;
}

double SphereTracer::outside(const glm::dvec3& x) const {
  const std::optional<std::size_t> cell = cell_of(x);
  double least = reach_;
  if (cell)
    for (const std::uint32_t i : sphere_cells_.at(*cell))
      least = std::min(least, glm::distance(x, spheres_[i].center) - spheres_[i].radius);
  return least;
}

NearestProbe SphereTracer::nearest(const glm::dvec3& x) const {
  NearestProbe best;
  best.distance = reach_;
  if (outside(x) >= 0.0) {
    best.distance = 0.0;
    best.center = x;
    return best;
  }
  const std::size_t cell = *cell_of(x);
  for (const std::uint32_t v : vertex_cells_.at(cell)) {
    const double d = glm::distance(x, vertices_[v].center);
    if (d < best.distance) best = {d, vertices_[v].center, PatchKind::concave, vertices_[v].atom};
  }
  for (const std::uint32_t n : circle_cells_.at(cell)) {
    const Circle& c = circles_[n];
    const glm::dvec3 y = nearest_on_circle(x, c.center, c.axis, c.radius);
    const double d = glm::distance(x, y);
    if (d >= best.distance) continue;
    if (covered(y, {circle_blockers_.data() + c.first_blocker, c.blocker_count}, kNone, kNone)) continue;
    best = {d, y, PatchKind::toroidal, {c.atom[0], c.atom[1], kNone}};
  }
  for (const std::uint32_t i : sphere_cells_.at(cell)) {
    const Sphere& s = spheres_[i];
    const double from_center = glm::distance(x, s.center), d = std::abs(from_center - s.radius);
    if (!s.exposed || d >= best.distance || !(from_center > 0.0)) continue;
    const glm::dvec3 y = s.center + (x - s.center) * (s.radius / from_center);
    if (covered(y, {sphere_blockers_.data() + s.first_blocker, s.blocker_count}, i, i)) continue;
    best = {d, y, PatchKind::convex, {i, kNone, kNone}};
  }
  return best;
}

double SphereTracer::cell_exit(const glm::dvec3& x, const glm::dvec3& direction) const {
  const glm::dvec3 in_grid = (x - grid_low_) / cell_size_;
  double exit = 1e300;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const double border = direction[k] > 0.0 ? std::floor(in_grid[k]) + 1.0 : std::floor(in_grid[k]);
    exit = std::min(exit, (border - in_grid[k]) * cell_size_ / direction[k]);
  }
  return exit + 1e-9;  // The point lies in the next cell.
}

std::optional<TraceHit> SphereTracer::trace(const glm::dvec3& origin, const glm::dvec3& direction, double t_max,
                                            double tolerance) const {
  // Only the grid's box can hold anything.
  const glm::dvec3 grid_high = grid_low_ + cell_size_ * glm::dvec3(cells_);
  double t = 0.0, t_end = t_max;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (origin[k] < grid_low_[k] || origin[k] > grid_high[k]) return std::nullopt;
      continue;
    }
    const double a = (grid_low_[k] - origin[k]) / direction[k], b = (grid_high[k] - origin[k]) / direction[k];
    t = std::max(t, std::min(a, b) + 1e-9);
    t_end = std::min(t_end, std::max(a, b));
  }
  while (t <= t_end) {
    const glm::dvec3 x = origin + t * direction;
    const std::optional<std::size_t> cell = cell_of(x);
    if (!cell) return std::nullopt;
    if (sphere_cells_.at(*cell).empty()) {
      t += cell_exit(x, direction);
      continue;
    }
    const double gap = outside(x);
    if (probe_radius_ > 0.0 && gap >= 0.0) {
      // The solid keeps a distance of p from every point of A, and all points within `gap` of x are in A.
      t += gap + probe_radius_;
      continue;
    }
    if (probe_radius_ == 0.0) {
      if (gap > tolerance) {
        t += gap;
        continue;
      }
      std::uint32_t touched = kNone;
      for (const std::uint32_t i : sphere_cells_.at(*cell))
        if (glm::distance(x, spheres_[i].center) - spheres_[i].radius <= gap) touched = i;
      return TraceHit{
          t, x, glm::normalize(x - spheres_[touched].center), {0.0, x, PatchKind::convex, {touched, kNone, kNone}}};
    }
    const NearestProbe probe = nearest(x);
    if (probe.distance >= probe_radius_ - tolerance) {
      const glm::dvec3 normal = probe.distance < reach_ ? (probe.center - x) / probe.distance : -direction;
      return TraceHit{t, x, normal, probe};
    }
    t += probe_radius_ - probe.distance;
  }
  return std::nullopt;
}

}  // namespace meniscus::testing
