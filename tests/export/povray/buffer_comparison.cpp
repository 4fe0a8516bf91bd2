// SPDX-License-Identifier: BSD-3-Clause
// Traces one oracle ray per pixel, and four more where that one disagrees.
#include "tests/export/povray/buffer_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace meniscus::testing {
namespace {

constexpr double kPositionLimit = 0.01;
constexpr double kNormalLimit = 0.01;
constexpr double kNudge = 0.01;  // share of a pixel

struct Agreement {
  bool position = false, normal = false, kind = false, color = false;
  double error = 0.0;
  bool all() const { return position && normal && kind && color; }
};

// Finds the colour by brute force: of all balls that the probe touches, the one in whose direction x lies gives it.
int color_at(const TraceHit& hit, std::span<const Ball> balls, double probe_radius, std::span<const int> colors) {
  double best = -2.0;
  int color = -1;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    const glm::dvec3 to_atom = balls[a].center - hit.probe.center;
    const double distance = glm::length(to_atom);
    if (std::abs(distance - balls[a].radius - probe_radius) > 1e-6) continue;
    const double nearness = glm::dot(to_atom / distance, -hit.normal);
    if (nearness > best) best = nearness, color = colors[a];
  }
  return color;
}

}  // namespace

std::string BufferDifference::text() const {
  std::ostringstream out;
  out << pixels << " px, " << surface << " surface; wrong: position " << position << ", normal " << normal << ", kind "
      << kind << ", colour " << color << ", odd layers " << odd_layers << "; largest position error "
      << largest_position_error << " A";
  return out.str();
}

BufferDifference compare_buffers(const Buffers& b, const SphereTracer& tracer, std::span<const Ball> balls,
                                 double probe_radius, std::span<const int> colors, const Camera& camera,
                                 const glm::dvec3& origin) {
  const auto agreement = [&](std::size_t n, const glm::dvec2& pixel) {
    const Ray ray = pixel_ray(camera, {b.width, b.height}, pixel);
    const auto hit = tracer.trace(ray.origin, ray.direction, 1e6, 1e-8);
    if (!hit || !b.hit[n]) {
      const bool both_miss = !hit && !b.hit[n];
      return Agreement{both_miss, both_miss, both_miss, both_miss, 0.0};
    }
    Agreement a;
    a.error = glm::distance(hit->point - origin, b.position[n]);
    a.position = a.error <= kPositionLimit;
    const glm::dvec3 facing = glm::dot(hit->normal, ray.direction) > 0.0 ? -hit->normal : hit->normal;
    a.normal = glm::distance(facing, b.normal[n]) <= kNormalLimit;
    a.kind = static_cast<int>(hit->probe.kind) == b.kind[n];
    a.color = color_at(*hit, balls, probe_radius, colors) == b.color[n];
    return a;
  };
  BufferDifference d;
  d.pixels = static_cast<std::size_t>(b.width) * b.height;
  for (std::size_t n = 0; n < d.pixels; ++n) {
    const glm::dvec2 center(n % b.width + 0.5, static_cast<double>(n / b.width) + 0.5);
    Agreement a = agreement(n, center);
    for (const glm::dvec2& nudge : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      if (a.all()) break;
      const Agreement other = agreement(n, center + kNudge * nudge);
      if (!a.position && other.position) a.error = other.error;
      a = {a.position || other.position, a.normal || other.normal, a.kind || other.kind, a.color || other.color,
           a.error};
    }
    d.surface += b.hit[n] != 0;
    d.position += !a.position;
    d.normal += !a.normal;
    d.kind += !a.kind;
    d.color += !a.color;
    d.odd_layers += b.layers[n] < kMostLayers && b.layers[n] % 2 != 0;
    if (a.position) d.largest_position_error = std::max(d.largest_position_error, a.error);
  }
  return d;
}

}  // namespace meniscus::testing
