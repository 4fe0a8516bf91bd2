// SPDX-License-Identifier: BSD-3-Clause
// Integrates 1 and x·n over convex, toroidal and concave faces (x measured from the middle of the molecule).
#include "core/surface/measure.h"

#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/surface/components.h"
#include "core/surface/convex_planes.h"
#include "core/surface/parallel_tables.h"
#include "core/surface/spherical.h"

namespace meniscus {
namespace {

constexpr double kRounding = 1e-9;  // relative to a solid angle
constexpr double kMisfit = 1e-9;    // largest misfit of a loop for which its turning is trusted
constexpr double kShort = 1e-6;     // radians: on shorter arcs the turning at corners is not reliable

struct Trust {
  bool doubtful = false;  // corners are blurred: the area was integrated about a pole
  bool disputed = false;  // the two closed forms give different areas
};

struct FaceIntegrals {
  double area = 0.0;  // Å²
  double flux = 0.0;  // integral of x·n, Å³
  Trust trust;
};

class Measurement {
 public:
  Measurement(Surface& surface, const glm::dvec3& origin, const ConvexPlanes& planes)
      : s_(surface), planes_(planes), origin_(origin) {}

  MeasuredFaces run() {
    MeasuredFaces all;
    all.flux.resize(s_.faces.size());
    std::vector<Trust> trust(s_.faces.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.faces.size(), 64), [&](const auto& range) {
      std::vector<SphereArc> loop;
      for (std::size_t f = range.begin(); f != range.end(); ++f) {
        prefetch_atoms(f + kPrefetchAhead);
        const FaceIntegrals measured = measure(s_.faces[f], loop);
        s_.faces[f].area = measured.area;
        all.flux[f] = measured.flux;
        trust[f] = measured.trust;
      }
    });
    for (std::uint32_t f = 0; f < s_.faces.size(); ++f) {
      if (trust[f].doubtful) all.doubts.doubtful.push_back(f);
      if (trust[f].disputed) all.doubts.disputed.push_back(f);
    }
    return all;
  }

 private:
  [[gnu::always_inline]] void prefetch_atoms(std::size_t face) const {
    if (face >= s_.faces.size() || s_.faces[face].kind != PatchKind::toroidal) return;
    for (const std::uint32_t atom : s_.toroidal[s_.faces[face].patch].atom) prefetch(s_.atoms, atom);
  }

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
    double area = 4 * std::numbers::pi, misfit = 0, shortest = 1;
    glm::dvec3 moment(0.0);
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      walk_loop(s_, s_.loops[l], center, radius, seen_from_inside, loop);
      area += area_left_of(loop) - 4 * std::numbers::pi;
      moment += moment_left_of(loop);
      const double misfit_here = misfit_of(loop);
      if (misfit_here > kMisfit) moment += moment_of_steps(loop);
      misfit = std::max(misfit, misfit_here);
      shortest = std::min(shortest, shortest_of(loop));
    }
    FaceIntegrals integrals;
    if (misfit > kMisfit) {
      const double turned = area;
      area = area_about_pole(face, center, radius, seen_from_inside, loop);
      integrals.trust.doubtful = true;
      integrals.trust.disputed = !(std::abs(area - turned) <= 1e-5 + 8 * misfit);
    } else if (shortest < kShort) {
      integrals.trust.disputed =
          !(std::abs(area - area_about_pole(face, center, radius, seen_from_inside, loop)) <= 1e-5 + 8 * kShort);
    }
    // The largest error of a zero or whole area by rounding and blurred corners.
    const double blur = kRounding + 8 * misfit;
    if (area < blur && area > -blur) area = std::max(area, 0.0);
    if (area > 4 * std::numbers::pi - blur && area < 4 * std::numbers::pi + blur)
      area = std::min(area, 4 * std::numbers::pi);
    integrals.area = area * radius * radius;
    // On the outside of a sphere x·n = (center + radius u)·u; seen from inside the normal is -u.
    const double outward = radius * radius * glm::dot(center - origin_, moment) + radius * integrals.area;
    integrals.flux = seen_from_inside ? -outward : outward;
    return integrals;
  }

  // Returns the solid angle of a face with corners too blurred for Gauss-Bonnet: integrated about a pole whose antipode
  // is known to lie inside or outside the face.
  double area_about_pole(const Face& face, const glm::dvec3& center, double radius, bool seen_from_inside,
                         std::vector<SphereArc>& loop) const {
    const Antipode antipode = face.kind == PatchKind::concave ? outside_concave(s_.concave[face.patch])
                                                              : farthest_known(face, center, radius, loop);
    double area = antipode.inside ? 4 * std::numbers::pi : 0;
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      walk_loop(s_, s_.loops[l], center, radius, seen_from_inside, loop);
      area += area_swept_from(-antipode.direction, loop);
    }
    return area;
  }

  struct Antipode {
    glm::dvec3 direction;
    bool inside;
  };

  // A concave patch lies in a half-space of the probe: it is within all sides, hence behind the plane whose normal is
  // the sum of theirs. The patch is at least a quarter turn away from that normal.
  Antipode outside_concave(const ConcavePatch& patch) const {
    glm::dvec3 normal(0.0);
    for (std::uint32_t n = patch.first_plane; n < patch.first_plane + patch.side_count; ++n)
      normal += s_.planes[n].normal;
    return {glm::normalize(normal), false};
  }

  // Returns the candidate that is farthest from the face's loops. Candidates are the middles of the caps that
  // neighbours cover, none of which is in the patch, and, if the patch is one piece, some fixed directions with a side
  // that all planes decide.
  Antipode farthest_known(const Face& face, const glm::dvec3& center, double radius,
                          std::vector<SphereArc>& loop) const {
    std::vector<Antipode> candidates;
    const std::vector<Plane> planes = planes_.of(face.patch, PlaneChoice::all);
    for (const Plane& plane : planes)
      if (plane.offset - glm::dot(plane.normal, center) < radius) candidates.push_back({plane.normal, false});
    if (s_.convex[face.patch].face_count == 1)
      for (int n = 0; n < 27; ++n) {
        if (n == 13) continue;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
        const glm::dvec3 x = center + radius * direction;
        candidates.push_back({direction, !cut_off_by(planes, x)});
      }
    std::vector<double> distance(candidates.size(), 4.0);
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      walk_loop(s_, s_.loops[l], center, radius, false, loop);
      for (std::size_t c = 0; c < candidates.size(); ++c)
        distance[c] = std::min(distance[c], std::abs(distance_left_of(candidates[c].direction, loop)));
    }
    const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
    return candidates.empty() ? Antipode{{0, 0, 1}, false} : candidates[static_cast<std::size_t>(farthest)];
  }

  FaceIntegrals measure_toroidal(const Face& face) const {
    const ToroidalPatch& t = s_.toroidal[face.patch];
    const double p = s_.probe_radius;
    const auto [begin, end] = tube_range(s_, t, static_cast<std::uint32_t>(&face - &s_.faces[t.first_face]));
    const glm::dvec3 i = toroidal_moments(s_, t, begin, end);
    const glm::dvec3 side = glm::cross(t.axis, t.start);
    const glm::dvec3 around = std::sin(t.sweep) * t.start + (1 - std::cos(t.sweep)) * side;
    const glm::dvec3 c = t.center - origin_;
    FaceIntegrals integrals;
    integrals.area = std::max(0.0, t.sweep * i.x);
    // n = cos psi e - sin psi axis, x·n = c·n + T cos psi - p.
    integrals.flux =
        glm::dot(c, around) * i.y - glm::dot(c, t.axis) * t.sweep * i.z + t.sweep * (t.radius * i.y - p * i.x);
    return integrals;
  }

  Surface& s_;
  const ConvexPlanes& planes_;
  const glm::dvec3 origin_;
};

}  // namespace

glm::dvec3 middle_of(std::span<const Ball> atoms) {
  glm::dvec3 low(0.0), high(0.0);
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    low = a ? glm::min(low, atoms[a].center) : atoms[a].center;
    high = a ? glm::max(high, atoms[a].center) : atoms[a].center;
  }
  return 0.5 * (low + high);
}

MeasuredFaces measure_faces(Surface& surface, const glm::dvec3& origin, const ConvexPlanes& planes) {
  return Measurement(surface, origin, planes).run();
}

std::vector<std::uint32_t> sort_components(std::vector<Component>& components) {
  std::vector<std::uint32_t> order(components.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
    const Component &a = components[x], &b = components[y];
    return a.kind != b.kind ? a.kind < b.kind : area_rank(a.area) > area_rank(b.area);
  });
  std::vector<std::uint32_t> rank(order.size());
  std::vector<Component> sorted;
  for (std::uint32_t n = 0; n < order.size(); ++n) {
    rank[order[n]] = n;
    sorted.push_back(components[order[n]]);
  }
  components = std::move(sorted);
  return rank;
}

MeasurementDoubts measure_surface(Surface& surface, const ConvexPlanes& planes) {
  MeasuredFaces measured = measure_faces(surface, middle_of(surface.atoms), planes);
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    Component& component = surface.components[surface.faces[f].component];
    component.area += surface.faces[f].area;
    component.volume += measured.flux[f] / 3;
  }
  const std::vector<ComponentKind> sides = side_of_components(surface, planes);
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    Component& component = surface.components[c];
    component.kind = sides[c];
    surface.area += component.area;
    surface.volume += component.volume;
  }
  const std::vector<std::uint32_t> rank = sort_components(surface.components);
  for (Face& face : surface.faces) face.component = rank[face.component];
  return std::move(measured.doubts);
}

MeasurementDoubts measure_surface(Surface& surface) { return measure_surface(surface, ListedPlanes(surface)); }

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

glm::dvec3 toroidal_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high) {
  const double p = surface.probe_radius;
  const auto primitive = [&](double psi) {
    const double s = std::sin(psi), c = std::cos(psi);
    return glm::dvec3(p * (patch.radius * psi - p * s),                  // integral of p (T - p cos psi)
                      p * (patch.radius * s - p * 0.5 * (psi + s * c)),  // integral of the same times cos psi
                      p * (-patch.radius * c + 0.5 * p * c * c));        // integral of the same times sin psi
  };
  return primitive(high) - primitive(low);
}

double toroidal_area(const Surface& surface, const ToroidalPatch& patch, double low, double high) {
  const double p = surface.probe_radius;
  return patch.sweep * p * (patch.radius * (high - low) - p * (std::sin(high) - std::sin(low)));
}

}  // namespace meniscus
