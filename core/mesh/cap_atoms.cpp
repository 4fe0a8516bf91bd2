// SPDX-License-Identifier: BSD-3-Clause
// Finds the atom whose colour a point of a cap has: the nearest sphere, in a grid, farther and farther away.
#include "core/mesh/cap_atoms.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace meniscus {
namespace {

constexpr double kNextAtoms = 1.0;  // Å beyond the nearest atom in which others are looked for

}  // namespace

CapAtoms::CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part)
    : atoms_(std::move(atoms)), part_(std::move(part)), probe_radius_(probe_radius), grid_(atoms_, [this] {
        for (const Ball& ball : atoms_) largest_ = std::max(largest_, ball.radius);
        return largest_ + probe_radius_ + kNextAtoms;
      }()) {
  if (atoms_.empty() || part_.size() != atoms_.size()) throw Error("caps: each of some atoms has a part");
  has_parts_ = std::ranges::any_of(part_, [this](std::uint32_t p) { return p != part_[0]; });
}

double CapAtoms::distance(std::uint32_t atom, const glm::dvec3& point) const {
  return glm::distance(point, atoms_[atom].center) - atoms_[atom].radius;
}

CapAtoms::Nearest CapAtoms::nearest(const glm::dvec3& point) const {
  // An atom that is not found is farther than the reach.
  for (double reach = largest_ + probe_radius_ + kNextAtoms;; reach *= 2.0) {
    Nearest best;
    best.distance = std::numeric_limits<double>::infinity();
    grid_.for_each_near(point, reach, [&](std::uint32_t a) {
      const double d = distance(a, point);
      if (std::tie(d, a) >= std::tie(best.distance, best.atom)) return;
      best.distance = d;
      best.atom = a;
    });
    if (best.atom == kNone || best.distance > reach - largest_) continue;
    best.gap = reach - largest_ - best.distance;
    if (has_parts_)
      grid_.for_each_near(point, reach, [&](std::uint32_t a) {
        if (part_[a] != part_[best.atom]) best.gap = std::min(best.gap, distance(a, point) - best.distance);
      });
    return best;
  }
}

}  // namespace meniscus
