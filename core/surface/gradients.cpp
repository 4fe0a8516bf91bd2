// SPDX-License-Identifier: BSD-3-Clause
// Integrates the speed of the surface over its patches, and along arcs and cusps.
#include "core/surface/measure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Returns the integral over the arc of its directions from the circle's centre.
template <typename Arc>
glm::dvec3 integrated_direction(const Arc& arc) {
  return std::sin(arc.sweep) * arc.start + (1 - std::cos(arc.sweep)) * glm::cross(arc.axis, arc.start);
}

/// A saddle patch's circle as seen from its two atoms.
struct SharedCircle {
  std::array<double, 2> height;           ///< Å: height of the circle's centre above each atom's, along the axis
  double distance;                        ///< Å: distance of the atoms
  std::array<double, 2> extended_radius;  ///< Å
  glm::dvec3 direction;                   ///< the direction from the circle's centre, integrated over the arc

  SharedCircle(const Surface& surface, const ToroidalPatch& patch) : direction(integrated_direction(patch)) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Ball& atom = surface.atoms[patch.atom[side]];
      height[side] = glm::dot(patch.axis, patch.center - atom.center);
      extended_radius[side] = atom.radius + surface.probe_radius;
    }
    distance = height[0] - height[1];
  }

  /// Returns the integral over the arc, by angle, of the vectors from the atom's centre to the arc's points.
  glm::dvec3 seen_from(std::size_t side, const ToroidalPatch& patch) const {
    return height[side] * patch.sweep * patch.axis + patch.radius * direction;
  }
};

/// Returns the integral of x * dx / 2 about `origin` along a border; over a closed loop it is the vector area inside.
glm::dvec3 swept_area(const Border& border, bool backwards, const glm::dvec3& origin) {
  const glm::dvec3 chord = border.radius * ((std::cos(border.sweep) - 1) * border.start +
                                            std::sin(border.sweep) * glm::cross(border.axis, border.start));
  const glm::dvec3 forwards =
      0.5 * (glm::cross(border.center - origin, chord) + border.radius * border.radius * border.sweep * border.axis);
  return backwards ? -forwards : forwards;
}

/// Adds to each atom the vector area of the accessible part of its SAS sphere, scaled by scale(atom). By Stokes'
/// theorem it is half the integral of x * dx along the borders, for any surface between them.
template <typename Scale>
void add_vector_areas(const Surface& surface, const Scale& scale, Gradient& gradient) {
  for (const ToroidalPatch& patch : surface.toroidal) {
    const SharedCircle circle(surface, patch);
    for (std::size_t side = 0; side < 2; ++side) {
      // Counter-clockwise about the axis the accessible part is on the right for the first atom, left for the second.
      const glm::dvec3 swept =
          0.5 * patch.radius * (patch.radius * patch.sweep * patch.axis - circle.height[side] * circle.direction);
      gradient[patch.atom[side]] += (side == 0 ? -scale(patch.atom[side]) : scale(patch.atom[side])) * swept;
    }
  }
}

/// The derivative of a face's integral by the position of its probe: dot(pull, velocity of the probe) is the change.
class ProbePulls {
 public:
  explicit ProbePulls(const Surface& surface) : s_(surface), pull_(surface.concave.size(), glm::dvec3(0.0)) {
    const std::vector<std::uint32_t> tied = tied_atoms(surface);
    if (tied.empty()) return;
    throw RequestError(
        "one probe touches {} atoms at once ({}): the surface has no derivative there; move one atom "
        "slightly, or ask for that of the accessible surface",
        tied.size(), fmt::join(tied, ", "));
  }

  /// Adds, for each probe, the vector area of its patch, directed towards the probe.
  void add_vector_areas(double scale) {
    for (std::size_t n = 0; n < s_.concave.size(); ++n)
      for (const Face& face : faces_of(s_, s_.concave[n]))
        for_each_half_border(s_, face, [&](HalfBorder half) {
          pull_[n] += scale * swept_area(s_.borders[border_of(half)], is_backwards(half), s_.concave[n].center);
        });
  }

  /// Adds the growth of both patches along a cusp: the motion of the cusp along the other patch's normal, tan(half the
  /// angle between the normals) times the integral of each speed.
  void add_cusps() {
    for (const Border& border : s_.borders) {
      if (border.kind != BorderKind::cusp) continue;
      const std::array<std::uint32_t, 2> probe{s_.faces[border.face[0]].patch, s_.faces[border.face[1]].patch};
      const double apart = glm::distance(s_.concave[probe[0]].center, s_.concave[probe[1]].center);
      const glm::dvec3 direction = integrated_direction(border);
      for (const std::uint32_t n : probe)
        pull_[n] += apart / (2 * s_.probe_radius) *
                    (border.sweep * (s_.concave[n].center - border.center) - border.radius * direction);
    }
  }

  /// Distributes each pull to atoms. A probe keeps its distance from the three atoms that it touches: dot(n_k, velocity
  /// of the probe) = dot(n_k, velocity of the k-th atom).
  void add_to(Gradient& gradient) const {
    for (std::size_t n = 0; n < s_.concave.size(); ++n) {
      const ConcavePatch& patch = s_.concave[n];
      if (patch.face_count == 0) continue;
      const std::uint32_t* const contact = &s_.contacts[patch.first_contact];
      glm::dmat3 normals;
      for (int k = 0; k < 3; ++k) normals[k] = glm::normalize(patch.center - s_.atoms[contact[k]].center);
      const glm::dvec3 share = glm::inverse(normals) * pull_[n];
      for (int k = 0; k < 3; ++k) gradient[contact[k]] += share[k] * normals[k];
    }
  }

 private:
  const Surface& s_;
  std::vector<glm::dvec3> pull_;
};

/// Integrals over a slice of a saddle of the cosine and the sine of the tube angle, weighted by area or by the change
/// of area along the normal.
struct SliceMoments {
  double cosine, sine;
};

SliceMoments area_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high) {
  const glm::dvec3 moments = toroidal_moments(surface, patch, low, high);
  return {moments.y, moments.z};
}

/// Returns the moments weighted by curvature. The sum of principal curvatures is -1/p + cos psi / (T - p cos psi);
/// times the area element p (T - p cos psi) it is 2 p cos psi - T.
SliceMoments curvature_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high) {
  const double p = surface.probe_radius, radius = patch.radius;
  const auto primitive = [&](double psi) {
    const double s = std::sin(psi), c = std::cos(psi);
    return SliceMoments{p * (psi + s * c) - radius * s, p * s * s + radius * c};
  };
  const SliceMoments a = primitive(low), b = primitive(high);
  return {b.cosine - a.cosine, b.sine - a.sine};
}

/// Adds the saddles. At each angle the rolling probe keeps its distance from both atoms; its normal at tube angle psi,
/// cos psi e - sin psi axis, is a sum of the directions to them, and their speeds are known.
template <typename Moments>
void add_saddles(const Surface& surface, const Moments& moments_of, Gradient& gradient) {
  for (const ToroidalPatch& patch : surface.toroidal) {
    if (patch.face_count == 0) continue;
    const SharedCircle circle(surface, patch);
    SliceMoments moments{0.0, 0.0};
    for (std::uint32_t n = 0; n < patch.face_count; ++n) {
      const auto [low, high] = tube_range(surface, patch, n);
      const SliceMoments piece = moments_of(surface, patch, low, high);
      moments.cosine += piece.cosine;
      moments.sine += piece.sine;
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const double share = (moments.sine + circle.height[1 - side] * moments.cosine / patch.radius) / circle.distance;
      gradient[patch.atom[side]] += (side == 0 ? -share : share) * circle.seen_from(side, patch);
    }
  }
}

}  // namespace

Gradient accessible_area_gradient(const Surface& surface, std::span<const double> weights) {
  Gradient gradient(surface.atoms.size(), glm::dvec3(0.0));
  for (const ToroidalPatch& patch : surface.toroidal) {
    const SharedCircle circle(surface, patch);
    std::array<double, 2> weight;  // weight of each atom times its radius
    for (std::size_t side = 0; side < 2; ++side)
      weight[side] = (weights.empty() ? 1.0 : weights[patch.atom[side]]) * circle.extended_radius[side];
    // When the second atom moves by v, the arc on the first atom's sphere moves by -n_2 v / sin(angle between n_1, n_2)
    // away from the accessible part, and the same holds with the atoms exchanged. With sin = distance * radius / (R_1
    // R_2), the only divisor is the distance.
    const glm::dvec3 pull =
        (weight[0] * circle.seen_from(1, patch) - weight[1] * circle.seen_from(0, patch)) / circle.distance;
    gradient[patch.atom[0]] += pull;
    gradient[patch.atom[1]] -= pull;
  }
  return gradient;
}

Gradient accessible_volume_gradient(const Surface& surface) {
  Gradient gradient(surface.atoms.size(), glm::dvec3(0.0));
  add_vector_areas(
      surface, [](std::uint32_t) { return 1.0; }, gradient);
  return gradient;
}

std::vector<std::uint32_t> tied_atoms(const Surface& surface) {
  for (const ConcavePatch& patch : surface.concave)
    if (patch.face_count > 0 && patch.contact_count > 3)
      return {&surface.contacts[patch.first_contact], &surface.contacts[patch.first_contact] + patch.contact_count};
  return {};
}

Gradient volume_gradient(const Surface& surface) {
  Gradient gradient(surface.atoms.size(), glm::dvec3(0.0));
  // A contact patch is the accessible patch, scaled down towards the atom.
  add_vector_areas(
      surface,
      [&](std::uint32_t a) {
        const double shrunk = surface.atoms[a].radius / (surface.atoms[a].radius + surface.probe_radius);
        return shrunk * shrunk;
      },
      gradient);
  if (surface.probe_radius == 0.0) return gradient;
  add_saddles(surface, area_moments, gradient);
  ProbePulls pulls(surface);
  pulls.add_vector_areas(1.0);
  pulls.add_to(gradient);
  return gradient;
}

Gradient area_gradient(const Surface& surface) {
  if (surface.probe_radius == 0.0) return accessible_area_gradient(surface);
  Gradient gradient(surface.atoms.size(), glm::dvec3(0.0));
  add_vector_areas(
      surface,
      [&](std::uint32_t a) {
        const double r = surface.atoms[a].radius, extended = r + surface.probe_radius;
        return 2 * r / (extended * extended);
      },
      gradient);
  add_saddles(surface, curvature_moments, gradient);
  ProbePulls pulls(surface);
  pulls.add_vector_areas(-2 / surface.probe_radius);
  pulls.add_cusps();
  pulls.add_to(gradient);
  return gradient;
}

}  // namespace meniscus
