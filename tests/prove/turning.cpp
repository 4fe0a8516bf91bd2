// SPDX-License-Identifier: BSD-3-Clause
// Computes one more surface for each input, and two that enclose it for the few that differ.
#include "tests/prove/turning.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/prove/completeness.h"

namespace meniscus::testing {
namespace {

std::optional<Surface> surface_of(const Balls& balls, double probe_radius) {
  try {
    return compute_surface_cpu(balls, probe_radius);
  } catch (const OpenSurfaceError&) {
    return std::nullopt;
  }
}

Balls resized(Balls balls, double by) {
  for (Ball& b : balls) b.radius += by;
  return balls;
}

struct Sizes {
  double area, accessible, volume;
  explicit Sizes(const Surface& s) : area(s.area), accessible(accessible_area(s)), volume(s.volume) {}

  bool agrees(const Sizes& other, double noise) const {
    return std::abs(area - other.area) <= noise && std::abs(accessible - other.accessible) <= noise &&
           std::abs(volume - other.volume) <= noise;
  }
};

/// Returns the largest effect of rounding, and of probes that are merged within 1e-6 Å.
double noise_of(const Surface& s) {
  double size = s.probe_radius;
  for (const Ball& b : s.atoms) size = std::max(size, b.radius + s.probe_radius);
  const double spheres = static_cast<double>(s.convex.size() + s.concave.size() + s.toroidal.size());
  return 1e-8 * (1 + size) * (1 + size) * (1 + size) * spheres + 1e-7 * (1 + s.area);
}

/// Returns how far growth by g moves sizes at ties, where spheres touch and a probe moves by its square root.
double blur_of(const Surface& s, double growth) {
  double size = 0;
  for (const Ball& b : s.atoms) size = std::max(size, b.radius + s.probe_radius);
  return s.area * std::sqrt(2 * size * growth);
}

double growth_of(const Surface& s) {
  const std::vector<bool> swallowed = swallowed_atoms(s.atoms);
  const bool any = std::ranges::find(swallowed, true) != swallowed.end();
  return allowed_growth(s) + (any ? 1e-6 : 0.0);
}

/// A surface whose radii all grow or shrink by the same amount.
struct Resized {
  std::optional<Surface> surface;
  double growth = 0;  ///< Å, of either sign
};

/// Returns a surface of radii that differ by `growth` at least, and by so much that it is not the surface of nearer
/// radii: one that is exact for radii within 8e-7 Å says nothing of radii that are 3e-7 Å smaller.
Resized resized_beyond(const Balls& balls, double growth, double probe_radius) {
  constexpr double kLargest = 1e-4;
  Resized resized_surface;
  for (double g = growth; std::abs(g) < kLargest; g *= 3) {
    resized_surface = {surface_of(resized(balls, g), probe_radius), g};
    if (!resized_surface.surface || growth_of(*resized_surface.surface) < std::abs(g) / 2) break;
  }
  return resized_surface;
}

}  // namespace

Turning check_turning(const Surface& surface, const Balls& balls, std::uint32_t seed) {
  std::mt19937 random(seed);
  Balls turned = rotated(balls, random_rotation(random));
  turned = permuted(turned, random_order(turned.size(), random));
  const std::optional<Surface> other = surface_of(turned, surface.probe_radius);
  Turning verdict;
  verdict.refused = !other;
  if (!other) return verdict;
  const Completeness found = check_completeness(*other, turned, 40, random());
  verdict.lost = !found.lost.empty();
  if (verdict.lost) verdict.complaint = "turned: " + found.lost;
  if (!found.wrong.empty()) verdict.complaint = "turned: " + found.wrong;
  if (!verdict.complaint.empty()) return verdict;
  const Sizes here(surface), there(*other);
  const double noise = std::max(noise_of(surface), noise_of(*other));
  if (here.agrees(there, noise)) return verdict;

  verdict.tied = true;
  const double least = 3 * std::max(growth_of(surface), growth_of(*other));
  const Resized less = resized_beyond(balls, -least, surface.probe_radius);
  const Resized more = resized_beyond(balls, least, surface.probe_radius);
  if (!less.surface || !more.surface) return verdict;
  const Sizes inner(*less.surface), outer(*more.surface);
  const double growth = std::max(-less.growth, more.growth);
  // Probes within 1e-6 Å of each other count as one.
  const double tie = noise + blur_of(*more.surface, growth),
               blur = noise + blur_of(*more.surface, std::max(growth, 1e-6));
  const bool free_of_ties = inner.agrees(outer, noise);
  for (const Sizes& sizes : {here, there}) {
    const bool enclosed = sizes.volume >= inner.volume - blur && sizes.volume <= outer.volume + blur;
    if (!enclosed || (free_of_ties && !sizes.agrees(inner, tie)))
      verdict.complaint = fmt::format(
          "turned: area {} and {}, volume {} and {}; of radii {:.1e} Å smaller and larger {} and {}, {} and {}",
          here.area, there.area, here.volume, there.volume, growth, inner.area, outer.area, inner.volume, outer.volume);
  }
  return verdict;
}

}  // namespace meniscus::testing
