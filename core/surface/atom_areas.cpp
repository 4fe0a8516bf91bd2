// SPDX-License-Identifier: BSD-3-Clause
// Cuts saddles by a latitude and re-entrant faces by bisector planes; integrates along the borders of the shares.
#include "core/surface/atom_areas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/surface/measure.h"
#include "core/surface/spherical.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kTouching = 1 - 5e-9;  // of the probe radius; the cap beyond such a plane is 1e-4 radian wide

/// The great circle around a unit axis.
SphereCircle great_circle(const glm::dvec3& axis) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(axis, aside));
  return {axis, 0, x, glm::cross(axis, x)};
}

/// The parameters of a circle that are left after half-spaces have been cut away.
class Intervals {
 public:
  explicit Intervals(double length) : kept_{{0.0, length}} {}

  /// Keeps the points p of the circle with dot(normal, p) <= offset.
  void keep(const SphereCircle& circle, const glm::dvec3& normal, double offset) {
    const double a = glm::dot(normal, circle.x), b = glm::dot(normal, circle.y), size = std::hypot(a, b);
    const double room = offset - circle.height * glm::dot(normal, circle.axis);
    if (room >= size) return;
    if (room <= -size) {
      kept_.clear();
      return;
    }
    const double middle = std::atan2(b, a), half = std::acos(room / size);
    for (const double turn : {0.0, kTurn}) remove(middle - half + turn, middle + half + turn);
  }

  const std::vector<std::pair<double, double>>& kept() const { return kept_; }

 private:
  void remove(double low, double high) {
    rest_.clear();
    for (const auto& [from, to] : kept_) {
      if (low >= to || high <= from) {
        rest_.emplace_back(from, to);
        continue;
      }
      if (low > from) rest_.emplace_back(from, low);
      if (high < to) rest_.emplace_back(high, to);
    }
    std::swap(kept_, rest_);
  }

  std::vector<std::pair<double, double>> kept_, rest_;
};

class AreaDivider {
 public:
  explicit AreaDivider(const Surface& surface) : s_(surface) {}

  AtomAreas run() {
    areas_.surface.assign(s_.atoms.size(), 0.0);
    areas_.accessible.assign(s_.atoms.size(), 0.0);
    for (const ConvexPatch& patch : s_.convex) add(patch);
    for (const ToroidalPatch& patch : s_.toroidal) add(patch);
    std::vector<double> share(s_.contacts.size(), 0.0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.concave.size(), 64), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n)
        std::ranges::copy(divide(s_.concave[n], Cuts::beyond_touching), share.begin() + s_.concave[n].first_contact);
    });
    for (std::size_t n = 0; n < share.size(); ++n) areas_.surface[s_.contacts[n]] += share[n];
    require_sum();
    return std::move(areas_);
  }

  // The cell of a contact holds the points of the sphere that no other contact is nearer to. Its border consists of
  // parts of the patch's borders and of the bisectors. A cell never holds the antipode of its own contact, which any
  // other contact is nearer to: so the contact serves as the pole of the integral.
  // Returns Å² by contact. A probe that does no more than touch the sphere cuts nothing of it, but the plane towards it
  // may take a hair from a bisector, which no border makes up for: such planes are left out. What planes and borders
  // disagree about is asked with all of them.
  enum class Cuts { beyond_touching, all };
  std::vector<double> divide(const ConcavePatch& patch, Cuts cuts) const {
    std::vector<double> area(patch.contact_count, 0.0);
    if (patch.face_count == 0) return area;
    std::vector<glm::dvec3> contacts;
    for (std::uint32_t n = 0; n < patch.contact_count; ++n)
      contacts.push_back(glm::normalize(s_.atoms[s_.contacts[patch.first_contact + n]].center - patch.center));
    for (const Face& face : faces_of(s_, patch)) add_borders(face, patch.center, contacts, area);
    const std::vector<std::uint32_t> planes = planes_of(patch, cuts);
    for (std::uint32_t k = 1; k < contacts.size(); ++k)
      for (std::uint32_t j = 0; j < k; ++j) add_bisector(patch, planes, contacts, j, k, area);
    for (double& share : area) share = share * s_.probe_radius * s_.probe_radius;
    return area;
  }

 private:
  void add(const ConvexPatch& patch) {
    const double r = s_.atoms[patch.atom].radius, extended = r + s_.probe_radius;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f) {
      areas_.surface[patch.atom] += s_.faces[f].area;
      // Where the probe's centre is seen from the atom's centre, there it touches: the patch and the accessible part
      // of the grown sphere fill the same solid angle.
      areas_.accessible[patch.atom] += s_.faces[f].area * (extended / r) * (extended / r);
    }
  }

  // The contacts are the two ends of the tube's arc: half-way in angle the nearest one changes.
  void add(const ToroidalPatch& patch) {
    const std::array<double, 2> contact = contact_tube_angles(s_, patch);
    const double middle = 0.5 * (contact[0] + contact[1]);
    for (std::uint32_t n = 0; n < patch.face_count; ++n) {
      const auto [low, high] = tube_range(s_, patch, n);
      const double cut = std::clamp(middle, low, high);
      areas_.surface[patch.atom[0]] += toroidal_area(s_, patch, low, cut);
      areas_.surface[patch.atom[1]] += toroidal_area(s_, patch, cut, high);
    }
  }

  void add_borders(const Face& face, const glm::dvec3& center, const std::vector<glm::dvec3>& contacts,
                   std::vector<double>& area) const {
    for_each_half_border(s_, face, [&](HalfBorder half) {
      // Seen from inside of the sphere the face is on the other side.
      const SphereArc arc = sphere_arc(s_.borders[border_of(half)], !is_backwards(half), center, s_.probe_radius);
      const SphereCircle circle = circle_of(arc);
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        Intervals cell(std::abs(arc.sweep));
        for (std::size_t j = 0; j < contacts.size(); ++j)
          if (j != k) cell.keep(circle, contacts[j] - contacts[k], 0.0);
        for (const auto& [from, to] : cell.kept()) area[k] += area_swept_from(contacts[k], circle, from, to);
      }
    });
  }

  // Whoever computed the faces: what is divided among the atoms is all of it.
  void require_sum() const {
    const double sum = std::accumulate(areas_.surface.begin(), areas_.surface.end(), 0.0);
    const double noise = 1e-6 * (1 + s_.area);
    const auto least = std::ranges::min_element(areas_.surface);
    if (std::abs(sum - s_.area) <= noise && (least == areas_.surface.end() || *least >= -noise)) return;
    throw OpenSurfaceError(
        fmt::format("the areas of atoms, {} Å² in sum and {} Å² the least, do not make up the surface's {} Å²; nothing "
                    "was written; "
                    "please report this structure",
                    sum, *least, s_.area));
  }

  std::vector<std::uint32_t> planes_of(const ConcavePatch& patch, Cuts cuts) const {
    std::vector<std::uint32_t> planes(patch.plane_count());
    std::iota(planes.begin(), planes.end(), patch.first_plane);
    if (cuts == Cuts::all || patch.cut_count == 0) return planes;
    const std::vector<std::uint32_t> beyond = probes_beyond_cusps(patch);
    std::erase_if(planes, [&](std::uint32_t plane) {
      const std::uint32_t n = plane - patch.first_plane;
      if (n < patch.side_count || n >= patch.side_count + patch.cut_count) return false;
      if (s_.planes[plane].offset - glm::dot(s_.planes[plane].normal, patch.center) < kTouching * s_.probe_radius)
        return false;
      const std::uint32_t cut = s_.cuts[patch.first_cut + n - patch.side_count];
      return cut != kNone && std::ranges::find(beyond, cut) == beyond.end();
    });
    return planes;
  }

  std::vector<std::uint32_t> probes_beyond_cusps(const ConcavePatch& patch) const {
    std::vector<std::uint32_t> probes;
    for (const Face& face : faces_of(s_, patch))
      for_each_border(s_, face, [&](const Border& border) {
        if (border.kind != BorderKind::cusp) return;
        for (const std::uint32_t beyond : border.face)
          if (beyond != kNone) probes.push_back(s_.faces[beyond].patch);
      });
    return probes;
  }

  // Counter-clockwise about its axis the bisector has the cell of k on its left, that of j on its right.
  void add_bisector(const ConcavePatch& patch, const std::vector<std::uint32_t>& planes,
                    const std::vector<glm::dvec3>& contacts, std::size_t j, std::size_t k,
                    std::vector<double>& area) const {
    const SphereCircle circle = great_circle(glm::normalize(contacts[k] - contacts[j]));
    Intervals common(kTurn);
    for (std::size_t other = 0; other < contacts.size(); ++other)
      if (other != j && other != k) common.keep(circle, contacts[other] - contacts[k], 0.0);
    for (const std::uint32_t n : planes) {
      const Plane& plane = s_.planes[n];
      common.keep(circle, plane.normal, (plane.offset - glm::dot(plane.normal, patch.center)) / s_.probe_radius);
    }
    for (const auto& [from, to] : common.kept()) {
      area[k] += area_swept_from(contacts[k], circle, from, to);
      area[j] -= area_swept_from(contacts[j], circle, from, to);
    }
  }

  const Surface& s_;
  AtomAreas areas_;
};

}  // namespace

AtomAreas atom_areas(const Surface& surface) { return AreaDivider(surface).run(); }

double divided_area(const Surface& surface, const ConcavePatch& patch) {
  const std::vector<double> shares = AreaDivider(surface).divide(patch, AreaDivider::Cuts::all);
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

}  // namespace meniscus
