// SPDX-License-Identifier: BSD-3-Clause
// Numbers vertices and borders patch by patch, then places them all at once.
#include "core/surface/boundary.h"

#include "core/surface/parallel_tables.h"

namespace meniscus {
namespace {

class BorderPlacer {
 public:
  BorderPlacer(Surface& surface, const FixedProbes& probes, const CuspParts& cusps)
      : s_(surface), probes_(probes), cusps_(cusps), flat_(surface.probe_radius == 0) {}

  PlacedBorders run() {
    number_borders();
    place_vertices();
    place_borders();
    return std::move(placed_);
  }

 private:
  double p() const { return s_.probe_radius; }

  // Numbers of borders of toroidal patches and of vertices on their axes: totals, or counts before a patch.
  struct BorderNumbers {
    std::uint32_t border = 0, vertex = 0;
    BorderNumbers& operator+=(const BorderNumbers& more) {
      border += more.border;
      vertex += more.vertex;
      return *this;
    }
  };

  // Numbers the vertices: one per contact of each probe (the probe itself when its radius is 0), two per spindle
  // circle, one per point where three probes meet.
  void number_borders() {
    const auto count = [&](std::size_t t) {
      const bool free = s_.toroidal[t].free(), spindle = s_.spindle(s_.toroidal[t]);
      return BorderNumbers{flat_     ? 1u
                           : free    ? 2u
                           : spindle ? 6u
                                     : 4u,
                           spindle && cusps_.first_on_circle[t] == t ? 2u : 0u};
    };
    const std::size_t contact_count = flat_ ? probes_.count() : probes_.sides.size();
    const RowNumbers<BorderNumbers> numbers(s_.toroidal.size(), {0, static_cast<std::uint32_t>(contact_count)}, count);
    placed_.of_patch.resize(s_.toroidal.size());
    placed_.axis_vertex.resize(s_.toroidal.size());
    numbers.for_each([&](std::size_t t, BorderNumbers& next) {
      const bool spindle = s_.spindle(s_.toroidal[t]);
      placed_.of_patch[t] = {next.border, s_.toroidal[t].free(), spindle};
      next += count(t);
      placed_.axis_vertex[t] = spindle && cusps_.first_on_circle[t] == t ? next.vertex - 2 : kNone;
    });
    for (std::size_t t = 0; t < s_.toroidal.size(); ++t)
      if (placed_.of_patch[t].spindle) placed_.axis_vertex[t] = placed_.axis_vertex[cusps_.first_on_circle[t]];
    placed_.first_cusp = numbers.past().border;
    triple_vertex_ = numbers.past().vertex;
  }

  void place_vertices() {
    resize_large(s_.vertices, triple_vertex_ + cusps_.triple.size());
    tbb::parallel_for(std::size_t{0}, probes_.count(), [&](std::size_t probe) {
      if (flat_) {
        s_.vertices[probe] = probes_.position[probe];
        return;
      }
      for (std::uint32_t n = probes_.first_side[probe]; n < probes_.first_side[probe + 1]; ++n) {
        const Ball& atom = s_.atoms[probes_.sides[n].from];
        s_.vertices[n] = atom.center + glm::normalize(probes_.position[probe] - atom.center) * atom.radius;
      }
    });
    // All patches of a spindle circle write the same value.
    tbb::parallel_for(std::size_t{0}, s_.toroidal.size(), [&](std::size_t t) {
      if (placed_.axis_vertex[t] == kNone || cusps_.first_on_circle[t] != t) return;
      for (int side = 0; side < 2; ++side)
        s_.vertices[placed_.axis_vertex[t] + side] = axis_cusp(s_.toroidal[t], p(), side);
    });
    std::copy(cusps_.triple.begin(), cusps_.triple.end(), s_.vertices.begin() + triple_vertex_);
  }

  void place_borders() {
    side_at_.resize(s_.toroidal.size());
    tbb::parallel_for(std::size_t{0}, probes_.count(), [&](std::size_t probe) {
      for (std::uint32_t n = probes_.first_side[probe]; n < probes_.first_side[probe + 1]; ++n)
        side_at_[probes_.sides[n].toroidal][probes_.sides[n].at_end] = n;
    });
    resize_large(s_.borders, placed_.first_cusp + cusps_.arcs.size());
    tbb::parallel_for(std::size_t{0}, s_.toroidal.size(), [&](std::size_t t) { place_patch_borders(t); });
    tbb::parallel_for(std::size_t{0}, cusps_.arcs.size(), [&](std::size_t n) { place_cusp_border(n); });
  }

  // Returns the vertex where the probe at `end` of patch t touches atom `side` of the patch.
  std::uint32_t contact_vertex(std::size_t t, int end, int side) const {
    const std::uint32_t n = side_at_[t][end];
    const std::uint32_t probe = s_.toroidal[t].probe[end];
    if (flat_) return probe;
    // At the start of the patch the side runs from atom[0] to atom[1], at its end from atom[1] to atom[0].
    if (end == side) return n;
    return n + 1 == probes_.first_side[probe + 1] ? probes_.first_side[probe] : n + 1;
  }

  // Prefetches what place_patch_borders() will read of a later patch.
  [[gnu::always_inline]] void prefetch_patch(std::size_t t) const {
    if (t >= s_.toroidal.size()) return;
    const ToroidalPatch& patch = s_.toroidal[t];
    for (int n = 0; n < 2; ++n) {
      prefetch(s_.atoms, patch.atom[n]);
      prefetch(probes_.position, patch.probe[n]);
      prefetch(probes_.first_side, patch.probe[n]);
      prefetch(s_.vertices, side_at_[t][n]);
    }
  }

  void place_patch_borders(std::size_t t) {
    prefetch_patch(t + kPrefetchAhead);
    const ToroidalPatch& patch = s_.toroidal[t];
    const PatchBorders& b = placed_.of_patch[t];
    for (int side = 0; side < (flat_ ? 1 : 2); ++side) {
      const Ball& atom = s_.atoms[patch.atom[side]];
      const double ratio = atom.radius / (atom.radius + p());
      Border& border = s_.borders[b.contact(side)];
      border.kind = BorderKind::contact;
      border.center = atom.center + (patch.center - atom.center) * ratio;
      border.axis = patch.axis;
      border.radius = patch.radius * ratio;
      border.start = patch.start;
      border.sweep = patch.sweep;
      if (!b.free) border.vertex = {contact_vertex(t, 0, side), contact_vertex(t, 1, side)};
    }
    if (b.free || flat_) return;
    for (int end = 0; end < 2; ++end) {
      const glm::dvec3 probe = probes_.position[patch.probe[end]];
      const std::array<std::uint32_t, 2> contact = {contact_vertex(t, end, 0), contact_vertex(t, end, 1)};
      if (!b.spindle) {
        s_.borders[b.edge(end)] = edge_border(probe, patch, contact[0], contact[1]);
      } else {
        const std::uint32_t cusp = placed_.axis_vertex[t];
        s_.borders[b.half_edge(end, 0)] = edge_border(probe, patch, contact[0], cusp);
        s_.borders[b.half_edge(end, 1)] = edge_border(probe, patch, cusp + 1, contact[1]);
      }
    }
  }

  // Returns the shorter great-circle arc of the probe's sphere from vertex a to vertex b, in the plane of its axis.
  Border edge_border(const glm::dvec3& probe, const ToroidalPatch& patch, std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 d0 = s_.vertices[a] - probe, d1 = s_.vertices[b] - probe;
    Border border;
    border.kind = BorderKind::edge;
    border.center = probe;
    // Seen from the probe, the axis of the patch is upright and the walk goes up.
    border.axis = glm::normalize(glm::cross(glm::dvec3(patch.center - probe), patch.axis));
    if (patch.radius < 1e-9) border.axis = glm::normalize(glm::cross(d0, d1));
    border.radius = p();
    border.start = glm::normalize(d0 - border.axis * glm::dot(d0, border.axis));
    border.sweep = std::atan2(glm::dot(border.axis, glm::cross(d0, d1)), glm::dot(d0, d1));
    border.sweep = std::max(border.sweep, 0.0);
    border.vertex = {a, b};
    return border;
  }

  void place_cusp_border(std::size_t n) {
    const CuspArc& arc = cusps_.arcs[n];
    Border& border = s_.borders[placed_.first_cusp + n];
    border.kind = BorderKind::cusp;
    border.center = arc.center;
    border.axis = arc.axis;
    border.radius = arc.radius;
    border.start = arc.start;
    border.sweep = arc.sweep;
    for (int end = 0; end < 2; ++end) {
      if (arc.vertex[end] == kNone) continue;
      border.vertex[end] = arc.on_axis[end] ? placed_.axis_vertex[arc.vertex[end] / 2] + (arc.vertex[end] & 1)
                                            : triple_vertex_ + arc.vertex[end];
    }
  }

  Surface& s_;
  const FixedProbes& probes_;
  const CuspParts& cusps_;
  const bool flat_;  // true for a probe of radius 0: toroidal patches have no area, convex patches meet directly
  PlacedBorders placed_;
  std::uint32_t triple_vertex_ = 0;
  std::vector<std::array<std::uint32_t, 2>> side_at_;  // toroidal patch, end -> side of the probe at that end
};

}  // namespace

PlacedBorders place_borders(Surface& surface, const FixedProbes& probes, const CuspParts& cusps) {
  return BorderPlacer(surface, probes, cusps).run();
}

}  // namespace meniscus
