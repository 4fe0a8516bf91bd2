// SPDX-License-Identifier: BSD-3-Clause
// Clip planes of concave patches from their sides and cuts, of convex patches from their borders and what those leave.
#include "core/surface/trim.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/surface/ball_grid.h"
#include "core/surface/contour.h"
#include "core/surface/reduced_surface.h"

namespace meniscus {
namespace {

// Contact-circle plane of atom a towards atom b: the patch lies where dot(normal, x) <= offset.
Plane contact_plane(const Ball& a, const Ball& b, double probe_radius) {
  const glm::dvec3 d = b.center - a.center;
  const double distance = glm::length(d), ra = a.radius + probe_radius, rb = b.radius + probe_radius;
  const double height = (distance * distance + ra * ra - rb * rb) / (2 * distance) * (a.radius / ra);
  const glm::dvec3 normal = d / distance;
  return {normal, glm::dot(normal, a.center) + height};
}

struct Worker {
  std::vector<std::uint32_t> kept;
  std::vector<Blocker> blockers;
  std::vector<Blocker> neighbors;
  Contour contour;
};

class ConvexTrimmer {
 public:
  explicit ConvexTrimmer(Surface& surface)
      : s_(surface), largest_(0), weights_(decision_weights(surface.atoms, surface.probe_radius)) {
    for (const Ball& b : s_.atoms) largest_ = std::max(largest_, b.radius + s_.probe_radius + 2e-9);
  }

  void run() {
    const BallGrid grid(s_.atoms, largest_);
    swallowed_ = swallowed_atoms(s_.atoms, s_.probe_radius);
    index_patches();
    std::vector<std::vector<std::uint32_t>> kept(s_.convex.size());
    tbb::enumerable_thread_specific<Worker> workers;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.convex.size(), 32), [&](const auto& range) {
      Worker& w = workers.local();
      for (std::size_t c = range.begin(); c != range.end(); ++c) {
        choose(s_.convex[c].atom, grid, w);
        kept[c] = w.kept;
      }
    });
    for (std::size_t c = 0; c < kept.size(); ++c) {
      ConvexPatch& patch = s_.convex[c];
      patch.first_plane = static_cast<std::uint32_t>(s_.planes.size());
      patch.plane_count = static_cast<std::uint32_t>(kept[c].size());
      for (std::uint32_t b : kept[c])
        s_.planes.push_back(contact_plane(s_.atoms[patch.atom], s_.atoms[b], s_.probe_radius));
    }
  }

 private:
  // The other atom of every toroidal patch, by atom: the circles that border a convex patch.
  void index_patches() {
    first_.assign(s_.atoms.size() + 1, 0);
    for (const ToroidalPatch& t : s_.toroidal)
      for (std::uint32_t a : t.atom) ++first_[a + 1];
    for (std::size_t a = 1; a < first_.size(); ++a) first_[a] += first_[a - 1];
    partner_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const ToroidalPatch& t : s_.toroidal) {
      partner_[next[t.atom[0]]++] = t.atom[1];
      partner_[next[t.atom[1]]++] = t.atom[0];
    }
  }

  Blocker blocker(std::uint32_t a, std::uint32_t b) const {
    return {s_.atoms[b].center - s_.atoms[a].center, weights_[b], b};
  }

  // While some kept circle shows an arc that another atom covers, that atom's circle is needed as well. When none
  // does, the kept circles bound the patch: a spurious piece would have a spurious border on one of them.
  void choose(std::uint32_t a, const BallGrid& grid, Worker& w) const {
    w.kept.assign(partner_.begin() + first_[a], partner_.begin() + first_[a + 1]);
    std::sort(w.kept.begin(), w.kept.end());
    w.kept.erase(std::unique(w.kept.begin(), w.kept.end()), w.kept.end());
    w.blockers.clear();
    w.neighbors.clear();
    for (std::uint32_t b : w.kept) w.blockers.push_back(blocker(a, b));
    for (std::size_t n = 0; n < w.blockers.size();) {
      w.contour.expose(w.blockers[n].center, weights_[a], w.blockers[n].weight, w.blockers, n);
      std::uint32_t missing = kNone;
      if (w.contour.whole()) missing = covering(a, {1.0, 0.0}, {0.0, 1.0}, grid, w);
      for (const ExposedArc& arc : w.contour.arcs()) {
        if (missing != kNone) break;
        missing = covering(a, arc.begin, arc.end, grid, w);
      }
      if (missing == kNone) {
        ++n;
        continue;
      }
      w.kept.push_back(missing);
      w.blockers.push_back(blocker(a, missing));
      n = 0;
    }
  }

  // The atom that covers the middle of the arc from begin to end of the contour's circle deepest, or kNone.
  std::uint32_t covering(std::uint32_t a, const glm::dvec2& begin, const glm::dvec2& end, const BallGrid& grid,
                         Worker& w) const {
    if (w.neighbors.empty()) {
      grid.for_each_near(s_.atoms[a].center, s_.atoms[a].radius + s_.probe_radius + largest_, [&](std::uint32_t b) {
        if (b != a && !swallowed_[b]) w.neighbors.push_back(blocker(a, b));
      });
    }
    glm::dvec2 middle = begin + end;
    if (begin.x * end.y - begin.y * end.x < 0) middle = -middle;
    const double length = glm::length(middle);
    middle = length > 1e-6 ? middle / length : glm::dvec2(-begin.y, begin.x);
    const geometry::Circle& c = w.contour.circle();
    const glm::dvec3 point = c.axis * c.height + c.radius * (middle.x * c.u + middle.y * c.v);
    std::uint32_t deepest = kNone;
    double depth = 1e-8;  // decision weights blur the surface of a ball by 1e-8 Å² at most
    for (const Blocker& b : w.neighbors) {
      const glm::dvec3 d = point - b.center;
      const double inside = b.weight - glm::dot(d, d);
      if (inside > depth && std::find(w.kept.begin(), w.kept.end(), b.label) == w.kept.end()) {
        depth = inside;
        deepest = b.label;
      }
    }
    return deepest;
  }

  Surface& s_;
  double largest_;
  std::vector<double> weights_;
  std::vector<bool> swallowed_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> partner_;
};

}  // namespace

void list_concave_patches(Surface& surface, const FixedProbes& probes, const CuspParts& cusps) {
  surface.cuts = cusps.cuts;
  surface.concave.resize(probes.count());
  surface.contacts.reserve(probes.sides.size());
  for (const ProbeSide& side : probes.sides) surface.contacts.push_back(side.from);
  surface.planes.resize(probes.sides.size() + surface.cuts.size());
  tbb::parallel_for(std::size_t{0}, probes.count(), [&](std::size_t n) {
    const glm::dvec3 s = probes.position[n];
    ConcavePatch& patch = surface.concave[n];
    patch.center = s;
    patch.first_contact = probes.first_side[n];
    patch.contact_count = patch.side_count = probes.first_side[n + 1] - probes.first_side[n];
    patch.first_cut = cusps.first_cut[n];
    patch.cut_count = cusps.first_cut[n + 1] - cusps.first_cut[n];
    patch.first_plane = patch.first_contact + patch.first_cut;
    Plane* plane = surface.planes.data() + patch.first_plane;
    for (const ProbeSide& side : probes.sides_of(static_cast<std::uint32_t>(n))) {
      plane->normal = glm::normalize(
          glm::cross(surface.atoms[side.from].center - s, surface.atoms[side.to].center - s));
      plane->offset = glm::dot(plane->normal, s);
      ++plane;
    }
    for (std::uint32_t c = patch.first_cut; c < patch.first_cut + patch.cut_count; ++c) {
      const glm::dvec3 t = probes.position[cusps.cuts[c]];
      plane->normal = glm::normalize(t - s);
      plane->offset = glm::dot(plane->normal, 0.5 * (s + t));
      ++plane;
    }
  });
}

void trim_convex_patches(Surface& surface) { ConvexTrimmer(surface).run(); }

}  // namespace meniscus
