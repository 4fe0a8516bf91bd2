// SPDX-License-Identifier: BSD-3-Clause
// Reduces lattices in three dimensions, and finds nearest images in them.
#include "core/structure/periodic_cell.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace meniscus {
namespace {

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// Returns the vector v + i a + j b that is nearest to the origin. a and b must be reduced (Lagrange 1773).
glm::dvec3 nearest(const glm::dvec3& v, const glm::dvec3& a, const glm::dvec3& b) {
  const double aa = squared(a), ab = glm::dot(a, b), bb = squared(b);
  const double va = glm::dot(v, a), vb = glm::dot(v, b), determinant = aa * bb - ab * ab;
  const double i0 = std::round((va * bb - vb * ab) / determinant), j0 = std::round((vb * aa - va * ab) / determinant);
  glm::dvec3 best = v - i0 * a - j0 * b;
  const glm::dvec3 start = best;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const glm::dvec3 other = start + double(i) * a + double(j) * b;
      if (squared(other) < squared(best)) best = other;
    }
  }
  return best;
}

/// Returns Minkowski-reduced vectors of the same lattice, by greedy reduction, which is exact in three dimensions (I.
/// Semaev, A 3-dimensional lattice reduction algorithm, 2001).
glm::dmat3 reduced(glm::dmat3 v) {
  constexpr int kMostSteps = 1000;  // boxes of simulations need only a few
  for (int step = 0; step < kMostSteps; ++step) {
    if (squared(v[1]) < squared(v[0])) std::swap(v[0], v[1]);
    if (squared(v[2]) < squared(v[1])) std::swap(v[1], v[2]);
    if (squared(v[1]) < squared(v[0])) std::swap(v[0], v[1]);
    const glm::dvec3 shorter = v[1] - std::round(glm::dot(v[1], v[0]) / squared(v[0])) * v[0];
    if (squared(shorter) < squared(v[1])) {
      v[1] = shorter;
      continue;
    }
    const glm::dvec3 last = nearest(v[2], v[0], v[1]);
    if (squared(last) >= squared(v[2])) return v;
    v[2] = last;
  }
  return v;
}

}  // namespace

std::optional<PeriodicCell> PeriodicCell::of(const glm::dmat3& vectors) {
  const double volume = std::abs(glm::determinant(vectors));
  // Other edges are no box of atoms, and their squares would leave the range of double precision.
  constexpr double kShortestEdge = 1e-6, kLongestEdge = 1e9;
  double lengths = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(vectors[axis]);
    if (!(length >= kShortestEdge && length <= kLongestEdge)) return {};
    lengths *= length;
  }
  if (!std::isfinite(volume) || !(volume > 1e-6 * lengths)) return {};
  return PeriodicCell(reduced(vectors));
}

PeriodicCell::PeriodicCell(const glm::dmat3& reduced)
    : vectors_(reduced), inverse_(glm::inverse(reduced)), half_shortest_squared_(0.25 * squared(reduced[0])) {}

// In a Minkowski-reduced basis in three dimensions the nearest image is next to the rounded one.
glm::dvec3 PeriodicCell::shortest(glm::dvec3 d) const {
  if (squared(d) <= half_shortest_squared_) return d;
  const glm::dvec3 fraction = inverse_ * d;
  d -= vectors_ * glm::dvec3(std::round(fraction.x), std::round(fraction.y), std::round(fraction.z));
  if (squared(d) <= half_shortest_squared_) return d;
  glm::dvec3 best = d;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      for (int c = -1; c <= 1; ++c) {
        const glm::dvec3 image = d + vectors_ * glm::dvec3(a, b, c);
        if (squared(image) < squared(best)) best = image;
      }
    }
  }
  return best;
}

}  // namespace meniscus
