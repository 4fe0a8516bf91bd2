// SPDX-License-Identifier: BSD-3-Clause
// Integrals of 1 and of x·n over convex, toroidal and concave faces (x measured from the middle of the molecule).
#include "core/surface/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/surface/spherical.h"

namespace meniscus {
namespace {

constexpr double kPi = std::numbers::pi;

struct FaceIntegrals {
  double area = 0.0;  // Å²
  double flux = 0.0;  // integral of x·n, Å³; a third of it is the face's share of the volume
};

class Measurement {
 public:
  explicit Measurement(Surface& surface) : s_(surface) {
    glm::dvec3 low(0.0), high(0.0);
    for (std::size_t a = 0; a < s_.atoms.size(); ++a) {
      low = a ? glm::min(low, s_.atoms[a].center) : s_.atoms[a].center;
      high = a ? glm::max(high, s_.atoms[a].center) : s_.atoms[a].center;
    }
    origin_ = 0.5 * (low + high);
  }

  void run() {
    std::vector<double> flux(s_.faces.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.faces.size(), 64), [&](const auto& range) {
      std::vector<SphereArc> loop;
      for (std::size_t f = range.begin(); f != range.end(); ++f) {
        const FaceIntegrals integrals = measure(s_.faces[f], loop);
        s_.faces[f].area = integrals.area;
        flux[f] = integrals.flux;
      }
    });
    for (std::size_t f = 0; f < s_.faces.size(); ++f) {
      Component& component = s_.components[s_.faces[f].component];
      component.area += s_.faces[f].area;
      component.volume += flux[f] / 3;
    }
    for (Component& component : s_.components) {
      component.kind = component.volume < 0 ? ComponentKind::cavity : ComponentKind::outer;
      s_.area += component.area;
      s_.volume += component.volume;
    }
    sort_components();
  }

 private:
  FaceIntegrals measure(const Face& face, std::vector<SphereArc>& loop) const {
    switch (face.kind) {
      case PatchKind::convex: {
        const Ball& atom = s_.atoms[s_.convex[face.patch].atom];
        return measure_spherical(face, atom.center, atom.radius, false, loop);
      }
      case PatchKind::concave:
        return measure_spherical(face, s_.concave[face.patch].center, s_.probe_radius, true, loop);
      default:
        return measure_toroidal(face);
    }
  }

  FaceIntegrals measure_spherical(const Face& face, const glm::dvec3& center, double radius, bool seen_from_inside,
                                  std::vector<SphereArc>& loop) const {
    double area = 4 * kPi;
    glm::dvec3 moment(0.0);
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      loop.clear();
      const Loop& walk = s_.loops[l];
      for (std::uint32_t n = 0; n < walk.half_border_count; ++n) {
        const HalfBorder h = s_.half_borders[walk.first_half_border + n];
        loop.push_back(sphere_arc(s_.borders[h / 2], ((h & 1) != 0) != seen_from_inside, center, radius));
      }
      if (seen_from_inside) std::reverse(loop.begin(), loop.end());
      area += area_left_of(loop) - 4 * kPi;
      moment += moment_left_of(loop);
    }
    FaceIntegrals integrals;
    integrals.area = area * radius * radius;
    // On the outside of a sphere x·n = (center + radius u)·u; seen from inside the normal is -u.
    const double outward = radius * radius * glm::dot(center - origin_, moment) + radius * integrals.area;
    integrals.flux = seen_from_inside ? -outward : outward;
    return integrals;
  }

  FaceIntegrals measure_toroidal(const Face& face) const {
    const ToroidalPatch& t = s_.toroidal[face.patch];
    const double p = s_.probe_radius;
    const auto [begin, end] = tube_range(s_, t, static_cast<std::uint32_t>(&face - &s_.faces[t.first_face]));
    const auto primitive = [&](double psi) {
      const double s = std::sin(psi), c = std::cos(psi);
      return glm::dvec3(p * (t.radius * psi - p * s),                  // of p (T - p cos psi)
                        p * (t.radius * s - p * 0.5 * (psi + s * c)),  // ... times cos psi
                        p * (-t.radius * c + 0.5 * p * c * c));        // ... times sin psi
    };
    const glm::dvec3 i = primitive(end) - primitive(begin);
    const glm::dvec3 side = glm::cross(t.axis, t.start);
    const glm::dvec3 around = std::sin(t.sweep) * t.start + (1 - std::cos(t.sweep)) * side;
    const glm::dvec3 c = t.center - origin_;
    FaceIntegrals integrals;
    integrals.area = t.sweep * i.x;
    // n = cos psi e - sin psi axis, x·n = c·n + T cos psi - p.
    integrals.flux =
        glm::dot(c, around) * i.y - glm::dot(c, t.axis) * t.sweep * i.z + t.sweep * (t.radius * i.y - p * i.x);
    return integrals;
  }

  void sort_components() {
    std::vector<std::uint32_t> order(s_.components.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
      const Component &a = s_.components[x], &b = s_.components[y];
      return a.kind != b.kind ? a.kind < b.kind : a.area > b.area;
    });
    std::vector<std::uint32_t> rank(order.size());
    std::vector<Component> sorted;
    for (std::uint32_t n = 0; n < order.size(); ++n) {
      rank[order[n]] = n;
      sorted.push_back(s_.components[order[n]]);
    }
    s_.components = std::move(sorted);
    for (Face& face : s_.faces) face.component = rank[face.component];
  }

  Surface& s_;
  glm::dvec3 origin_{0.0};
};

}  // namespace

void measure_surface(Surface& surface) { Measurement(surface).run(); }

std::array<double, 2> contact_tube_angles(const Surface& surface, const ToroidalPatch& patch) {
  const Ball &a = surface.atoms[patch.atom[0]], &b = surface.atoms[patch.atom[1]];
  return {std::atan2(glm::dot(patch.axis, a.center - patch.center), patch.radius),
          std::atan2(glm::dot(patch.axis, b.center - patch.center), patch.radius)};
}

std::array<double, 2> tube_range(const Surface& surface, const ToroidalPatch& patch, std::uint32_t n) {
  std::array<double, 2> range = contact_tube_angles(surface, patch);
  if (!surface.spindle(patch)) return range;
  const double tip = std::acos(std::min(1.0, patch.radius / surface.probe_radius));
  if (patch.piece(n) == 0)
    range[1] = -tip;
  else
    range[0] = tip;
  return range;
}

double toroidal_area(const Surface& surface, const ToroidalPatch& patch, double low, double high) {
  const double p = surface.probe_radius;
  return patch.sweep * p * (patch.radius * (high - low) - p * (std::sin(high) - std::sin(low)));
}

}  // namespace meniscus
