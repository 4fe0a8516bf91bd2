// SPDX-License-Identifier: BSD-3-Clause
// Maps faces to the plane by stereographic or toroidal conformal coordinates, measures how far flat triangles are from
// spheres and tori, and spreads points on a sphere.
#include "core/mesh/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

#include "core/mesh/remesh_tuning.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// The range of the share of a full turn that a spindle's half occupies in the plane. The share is that of the unrolled
/// cone at its tip, but not so large that the sides of a full turn meet, nor zero where the tube just touches the axis.
constexpr double kNarrowestOpening = 0.1;
constexpr double kWidestOpening = 0.9;
/// Keeps the radial coordinate of tubes that just touch their axis from becoming constant.
constexpr double kSmallestTip = 0.05;

/// Returns any unit vector perpendicular to a unit vector.
glm::dvec3 perpendicular(const glm::dvec3& v) {
  const glm::dvec3 other = std::abs(v.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, other));
}

}  // namespace

SphereDomain::SphereDomain(const glm::dvec3& center, double radius, std::span<const Plane> planes,
                           const glm::dvec3& pole, bool inwards)
    : center_(center), pole_(pole), right_(perpendicular(pole)), planes_(planes), radius_(radius), inwards_(inwards) {
  // Opposite the pole the outward normal is -pole; (right, up, normal) must be right-handed.
  up_ = inwards ? glm::cross(pole, right_) : glm::cross(right_, pole);
}

glm::dvec2 SphereDomain::flat(const FacePoint& point) const {
  const glm::dvec3 u = (point.position - center_) / radius_;
  const double below = 1.0 - glm::dot(u, pole_);
  return {glm::dot(u, right_) / below, glm::dot(u, up_) / below};
}

bool SphereDomain::contains(const FacePoint& point) const {
  return std::all_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return glm::dot(plane.normal, point.position) <= plane.offset; });
}

FacePoint SphereDomain::between(const std::array<const FacePoint*, 3>& points,
                                const std::array<double, 3>& weights) const {
  glm::dvec3 sum(0.0);
  for (int k = 0; k < 3; ++k) sum += weights[k] * (points[k]->position - center_);
  return at(glm::normalize(sum));
}

double SphereDomain::deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const {
  // The point of the triangle nearest to the centre is the foot of the perpendicular, the triangle's circumcentre,
  // or, if that lies outside, the middle of the longest edge.
  std::array<double, 3> edge{glm::distance(a.position, b.position), glm::distance(b.position, c.position),
                             glm::distance(c.position, a.position)};
  std::sort(edge.begin(), edge.end());
  const auto [s0, s1, s2] = edge;
  double half = 0.5 * s2;
  if (s0 * s0 + s1 * s1 > s2 * s2) {
    const double twice_area = glm::length(glm::cross(b.position - a.position, c.position - a.position));
    half = s0 * s1 * s2 / (2.0 * twice_area);
  }
  return half >= radius_ ? radius_ : half * half / (radius_ + std::sqrt(radius_ * radius_ - half * half));
}

glm::dvec3 SphereDomain::normal(const FacePoint& point) const {
  const glm::dvec3 u = glm::normalize(point.position - center_);
  return inwards_ ? -u : u;
}

TorusDomain::TorusDomain(const ToroidalPatch& patch, double tube_radius, int piece)
    : patch_(patch),
      tube_radius_(tube_radius),
      piece_(piece),
      is_spindle_(patch.face_count == 2 || !patch.has_piece[0] || !patch.has_piece[1]) {
  if (patch.radius <= tube_radius) {
    tip_ = std::acos(patch.radius / tube_radius);
    tan_tip_ = std::sqrt((tube_radius - patch.radius) / (tube_radius + patch.radius));
  }
}

double TorusDomain::axis_distance(double tube) const { return patch_.radius - tube_radius_ * std::cos(tube); }

FacePoint TorusDomain::at(double theta, double tube) const {
  const glm::dvec3 radial = arc_direction(patch_, theta);
  return {patch_.center + axis_distance(tube) * radial + tube_radius_ * std::sin(tube) * patch_.axis, {theta, tube}};
}

glm::dvec2 TorusDomain::flat(const FacePoint& point) const {
  const double theta = point.angles.x, half_tan = std::tan(0.5 * point.angles.y);
  if (tube_radius_ == 0.0) return point.angles;  // a saddle without width: any map will do
  // d(height) = p d(tube) / (distance from the axis), integrated in closed form.
  if (!is_spindle_ && tip_ > 0.0) {
    const double t = std::abs(half_tan), height = std::log((t - tan_tip_) / (t + tan_tip_)) / std::sin(tip_);
    return {theta, half_tan < 0.0 ? -height : height};
  }
  if (!is_spindle_) {
    const double ratio = std::max(patch_.radius / tube_radius_, 1.0 + 1e-9);
    const double root = std::sqrt((ratio - 1.0) * (ratio + 1.0));
    return {theta, 2.0 / root * std::atan(std::sqrt((ratio + 1.0) / (ratio - 1.0)) * half_tan)};
  }
  const double t = std::max(std::abs(half_tan), tan_tip_);
  const double r = (t - tan_tip_) / (t + std::max(tan_tip_, kSmallestTip));
  const double opening = std::clamp(std::sin(tip_), kNarrowestOpening, kWidestOpening);
  const double angle = (piece_ == 0 ? opening : -opening) * (theta - 0.5 * patch_.sweep);
  return {r * std::cos(angle), r * std::sin(angle)};
}

FacePoint TorusDomain::between(const std::array<const FacePoint*, 3>& points,
                               const std::array<double, 3>& weights) const {
  // The tip of a spindle has every theta, so only the other points determine it.
  double theta = 0.0, tube = 0.0, share = 0.0;
  for (int k = 0; k < 3; ++k) {
    tube += weights[k] * points[k]->angles.y;
    if (weights[k] == 0.0 || (is_spindle_ && points[k]->angles.y == tip_angle())) continue;
    theta += weights[k] * points[k]->angles.x;
    share += weights[k];
  }
  return at(share > 0.0 ? theta / share : 0.0, tube);
}

double TorusDomain::deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const {
  double worst = 0.0;
  for (const auto& w : RemeshTuning::sample_weights) {
    const glm::dvec3 x = w[0] * a.position + w[1] * b.position + w[2] * c.position - patch_.center;
    const double height = glm::dot(x, patch_.axis);
    const double out = glm::length(x - height * patch_.axis) - patch_.radius;
    worst = std::max(worst, std::abs(std::hypot(out, height) - tube_radius_));
  }
  return worst;
}

glm::dvec3 TorusDomain::normal(const FacePoint& point) const {
  const double theta = point.angles.x, tube = point.angles.y;
  const glm::dvec3 radial = arc_direction(patch_, theta);
  return glm::normalize(std::cos(tube) * radial - std::sin(tube) * patch_.axis);
}

glm::dvec3 TorusDomain::corner_normal(const FacePoint& point, const FacePoint& next, const FacePoint& last) const {
  if (!is_spindle_ || point.angles.y != tip_angle()) return normal(point);
  return normal({point.position, {0.5 * (next.angles.x + last.angles.x), point.angles.y}});
}

namespace {

std::array<glm::dvec3, 12> icosahedron() {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  std::array<glm::dvec3, 12> v{{{-1, g, 0},
                                {1, g, 0},
                                {-1, -g, 0},
                                {1, -g, 0},
                                {0, -1, g},
                                {0, 1, g},
                                {0, -1, -g},
                                {0, 1, -g},
                                {g, 0, -1},
                                {g, 0, 1},
                                {-g, 0, -1},
                                {-g, 0, 1}}};
  for (auto& p : v) p = glm::normalize(p);
  return v;
}

constexpr std::array<std::array<int, 3>, 20> kSides{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

}  // namespace

int lattice_frequency(double angle) {
  // The longest of n equal parts of a flat edge, seen from the centre, lies in the middle of a side: its half chord is
  // half the edge / n at the inradius of the icosahedron.
  const double edge = 2.0 / std::sqrt(std::pow((1.0 + std::sqrt(5.0)) / 2.0, 2) + 1.0);
  const double inradius = 0.7946544722917661;
  const double half = std::tan(std::min(angle, 1.2) / 2.0) * inradius;
  return std::max(1, static_cast<int>(std::ceil(edge / (2.0 * half))));
}

SphereLattice sphere_lattice(int frequency) {
  const auto corner = icosahedron();
  SphereLattice lattice;
  // A lattice point is identified by its barycentric weights at the named corners, so that sides share their rims.
  std::map<std::array<int, 6>, std::uint32_t> known;
  auto point = [&](const std::array<int, 3>& side, int a, int b, int c) {
    std::array<std::array<int, 2>, 3> part{{{side[0], a}, {side[1], b}, {side[2], c}}};
    for (auto& w : part) {
      if (w[1] == 0) w[0] = -1;
    }
    std::sort(part.begin(), part.end());
    const std::array<int, 6> name{part[0][0], part[0][1], part[1][0], part[1][1], part[2][0], part[2][1]};
    const auto [at, fresh] = known.try_emplace(name, static_cast<std::uint32_t>(lattice.directions.size()));
    if (fresh) {
      glm::dvec3 sum(0.0);
      for (const auto& w : part) sum += w[1] ? double(w[1]) * corner[w[0]] : glm::dvec3(0.0);
      lattice.directions.push_back(glm::normalize(sum));
    }
    return at->second;
  };
  const int n = frequency;
  for (const auto& side : kSides) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const int k = n - i - j;
        lattice.triangles.push_back({point(side, k, i, j), point(side, k - 1, i + 1, j), point(side, k - 1, i, j + 1)});
        if (k >= 2) {
          lattice.triangles.push_back(
              {point(side, k - 1, i + 1, j), point(side, k - 2, i + 1, j + 1), point(side, k - 1, i, j + 1)});
        }
      }
    }
  }
  return lattice;
}

}  // namespace meniscus
