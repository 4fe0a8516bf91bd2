// SPDX-License-Identifier: BSD-3-Clause
// Builds borders from patches, chains them into loops, groups loops into faces and faces into components.
#include "core/surface/boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/surface/loops.h"
#include "core/math/union_find.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

// Where the borders of one toroidal patch start, and what they are: contact circles first, then the ends.
struct PatchBorders {
  std::uint32_t first = 0;
  bool free = false;
  bool spindle = false;
  std::uint32_t contact(int side) const { return first + side; }
  std::uint32_t edge(int end) const { return first + 2 + end; }                            // not a spindle
  std::uint32_t half_edge(int end, int side) const { return first + 2 + 2 * end + side; }  // spindle
};

class BoundaryBuilder {
 public:
  BoundaryBuilder(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs)
      : s_(surface),
        probes_(probes),
        cusps_(cusps),
        rs_(rs),
        flat_(surface.probe_radius == 0),
        first_on_circle_(first_on_circle(surface.toroidal)) {}

  void run() {
    place_vertices();
    place_borders();
    chain_loops();
    number_faces();
    connect_components();
  }

 private:
  double p() const { return s_.probe_radius; }

  // Vertices: one per contact of each probe (the probe itself when its radius is 0), two per spindle circle, one per
  // point where three probes meet.
  void place_vertices() {
    const std::size_t contact_count = flat_ ? probes_.count() : probes_.sides.size();
    axis_vertex_.assign(s_.toroidal.size(), kNone);
    std::uint32_t count = static_cast<std::uint32_t>(contact_count);
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t) {
      if (first_on_circle_[t] != t || !s_.spindle(s_.toroidal[t])) continue;
      axis_vertex_[t] = count;
      count += 2;
    }
    triple_vertex_ = count;
    s_.vertices.resize(count + cusps_.triple.size());
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
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t)
      if (axis_vertex_[t] != kNone)
        for (int side = 0; side < 2; ++side) s_.vertices[axis_vertex_[t] + side] = axis_cusp(s_.toroidal[t], p(), side);
    std::copy(cusps_.triple.begin(), cusps_.triple.end(), s_.vertices.begin() + triple_vertex_);
  }

  void place_borders() {
    side_at_.resize(s_.toroidal.size());
    for (std::uint32_t n = 0; n < probes_.sides.size(); ++n)
      side_at_[probes_.sides[n].toroidal][probes_.sides[n].at_end] = n;
    patch_borders_.resize(s_.toroidal.size());
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t) {
      const bool free = s_.toroidal[t].free(), spindle = s_.spindle(s_.toroidal[t]);
      patch_borders_[t] = {count, free, spindle};
      count += flat_ ? 1 : free ? 2 : spindle ? 6 : 4;
    }
    first_cusp_border_ = count;
    s_.borders.resize(count + cusps_.arcs.size());
    tbb::parallel_for(std::size_t{0}, s_.toroidal.size(), [&](std::size_t t) { place_patch_borders(t); });
    for (std::size_t n = 0; n < cusps_.arcs.size(); ++n) place_cusp_border(n);
  }

  // The vertex of the probe at `end` of patch t on atom `side` of the patch.
  std::uint32_t contact_vertex(std::size_t t, int end, int side) const {
    const std::uint32_t n = side_at_[t][end];
    const std::uint32_t probe = s_.toroidal[t].probe[end];
    if (flat_) return probe;
    // At its start the side runs from atom[0] to atom[1], at its end the other way.
    if (end == side) return n;
    return n + 1 == probes_.first_side[probe + 1] ? probes_.first_side[probe] : n + 1;
  }

  void place_patch_borders(std::size_t t) {
    const ToroidalPatch& patch = s_.toroidal[t];
    const PatchBorders& b = patch_borders_[t];
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
        const std::uint32_t cusp = axis_vertex_[first_on_circle_[t]];
        s_.borders[b.half_edge(end, 0)] = edge_border(probe, patch, contact[0], cusp);
        s_.borders[b.half_edge(end, 1)] = edge_border(probe, patch, cusp + 1, contact[1]);
      }
    }
  }

  // The shorter great-circle arc of the probe's sphere from vertex a to vertex b, in the plane of the patch's axis.
  Border edge_border(const glm::dvec3& probe, const ToroidalPatch& patch, std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 d0 = s_.vertices[a] - probe, d1 = s_.vertices[b] - probe;
    Border border;
    border.kind = BorderKind::edge;
    border.center = probe;
    // Seen from the probe the axis of the patch stands upright and the walk goes up.
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
    Border& border = s_.borders[first_cusp_border_ + n];
    border.kind = BorderKind::cusp;
    border.center = arc.center;
    border.axis = arc.axis;
    border.radius = arc.radius;
    border.start = arc.start;
    border.sweep = arc.sweep;
    for (int end = 0; end < 2; ++end) {
      if (arc.vertex[end] == kNone) continue;
      border.vertex[end] = arc.on_axis[end] ? axis_vertex_[arc.vertex[end] / 2] + (arc.vertex[end] & 1)
                                            : triple_vertex_ + arc.vertex[end];
    }
  }

  // Half-borders by atom, then by probe; each patch chains its own.
  void chain_loops() {
    std::vector<std::uint32_t> first(s_.atoms.size() + 1, 0);
    for (const ToroidalPatch& t : s_.toroidal)
      for (std::uint32_t a : t.atom) ++first[a + 1];
    for (std::size_t a = 1; a < first.size(); ++a) first[a] += first[a - 1];
    std::vector<HalfBorder> of_atom(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t) {
      // Counter-clockwise about the axis the convex patch of atom[0] lies on the right, that of atom[1] on the left.
      of_atom[next[s_.toroidal[t].atom[0]]++] = patch_borders_[t].contact(0) * 2 + 1;
      of_atom[next[s_.toroidal[t].atom[1]]++] = patch_borders_[t].contact(flat_ ? 0 : 1) * 2;
    }
    for (std::uint32_t a = 0, lone = 0; a < s_.atoms.size(); ++a) {
      const bool is_lone = lone < rs_.lone_atoms.size() && rs_.lone_atoms[lone] == a;
      if (is_lone) ++lone;
      if (first[a + 1] > first[a] || is_lone) s_.convex.push_back({a, 0, 0, 0, 0});
    }
    convex_faces_.resize(s_.convex.size());
    tbb::parallel_for(std::size_t{0}, s_.convex.size(), [&](std::size_t c) {
      const std::uint32_t a = s_.convex[c].atom;
      const Ball& atom = s_.atoms[a];
      convex_faces_[c] = chain_faces(s_.borders, {of_atom.data() + first[a], of_atom.data() + first[a + 1]},
                                     atom.center, atom.radius, false);
    });

    if (flat_) return;
    std::vector<std::uint32_t> first_cusp(probes_.count() + 1, 0);
    for (const CuspArc& arc : cusps_.arcs)
      for (std::uint32_t s : arc.probe) ++first_cusp[s + 1];
    for (std::size_t s = 1; s < first_cusp.size(); ++s) first_cusp[s] += first_cusp[s - 1];
    std::vector<HalfBorder> of_probe(first_cusp.back());
    next.assign(first_cusp.begin(), first_cusp.end() - 1);
    for (std::uint32_t n = 0; n < cusps_.arcs.size(); ++n) {
      // Counter-clockwise about the axis from the first probe to the second, the first one's patch lies on the left.
      of_probe[next[cusps_.arcs[n].probe[0]]++] = (first_cusp_border_ + n) * 2;
      of_probe[next[cusps_.arcs[n].probe[1]]++] = (first_cusp_border_ + n) * 2 + 1;
    }
    concave_faces_.resize(s_.concave.size());
    tbb::parallel_for(std::size_t{0}, s_.concave.size(), [&](std::size_t s) {
      std::vector<HalfBorder> walk(of_probe.begin() + first_cusp[s], of_probe.begin() + first_cusp[s + 1]);
      for (const ProbeSide& side : probes_.sides_of(static_cast<std::uint32_t>(s))) {
        // At the start of a toroidal patch the concave patch lies on the left of its edge, at the end on the right.
        const PatchBorders& b = patch_borders_[side.toroidal];
        const std::uint32_t backwards = side.at_end ? 1 : 0;
        if (!b.spindle) {
          walk.push_back(b.edge(side.at_end) * 2 + backwards);
        } else {
          walk.push_back(b.half_edge(side.at_end, 0) * 2 + backwards);
          walk.push_back(b.half_edge(side.at_end, 1) * 2 + backwards);
        }
      }
      concave_faces_[s] = chain_faces(s_.borders, walk, s_.concave[s].center, p(), true);
    });
  }

  // How many faces, loops and half-borders there are, or how many stand before those of a patch.
  struct Numbers {
    std::uint32_t face = 0, loop = 0, half_border = 0;
    Numbers& operator+=(const Numbers& more) {
      face += more.face;
      loop += more.loop;
      half_border += more.half_border;
      return *this;
    }
  };

  static Numbers numbers_of(const PatchFaces& faces) {
    return {faces.face_count, static_cast<std::uint32_t>(faces.loop_sizes.size()),
            static_cast<std::uint32_t>(faces.half_borders.size())};
  }

  Numbers numbers_of(const PatchBorders& borders) const {
    if (flat_) return {};
    if (borders.spindle) return {2, 2, borders.free ? 2u : 6u};
    return borders.free ? Numbers{1, 2, 2} : Numbers{1, 1, 4};
  }

  // Faces are numbered in the order of convex, toroidal and concave patches; then each patch lists its own.
  void number_faces() {
    Numbers all;
    const auto before = [&](const auto& patches) {
      std::vector<Numbers> first;
      first.reserve(patches.size());
      for (const auto& patch : patches) {
        first.push_back(all);
        all += numbers_of(patch);
      }
      return first;
    };
    const auto first_convex = before(convex_faces_), first_toroidal = before(patch_borders_),
               first_concave = before(concave_faces_);
    s_.faces.resize(all.face);
    s_.loops.resize(all.loop);
    s_.half_borders.resize(all.half_border);
    tbb::parallel_for(std::size_t{0}, s_.convex.size(), [&](std::size_t c) {
      list_faces(convex_faces_[c], PatchKind::convex, s_.convex[c], static_cast<std::uint32_t>(c), first_convex[c]);
    });
    tbb::parallel_for(std::size_t{0}, s_.toroidal.size(),
                      [&](std::size_t t) { list_toroidal_faces(static_cast<std::uint32_t>(t), first_toroidal[t]); });
    tbb::parallel_for(std::size_t{0}, concave_faces_.size(), [&](std::size_t n) {
      list_faces(concave_faces_[n], PatchKind::concave, s_.concave[n], static_cast<std::uint32_t>(n), first_concave[n]);
    });
    for (std::uint32_t c = 0; c < s_.convex.size(); ++c)
      if (!convex_faces_[c].closed) s_.certificate.open_atoms.push_back(s_.convex[c].atom);
    for (std::uint32_t s = 0; s < concave_faces_.size(); ++s)
      if (!concave_faces_[s].closed) add_open_probe(s);
    for (std::uint32_t s : cusps_.open_probes) add_open_probe(s);
  }

  void add_open_probe(std::uint32_t s) {
    for (const ProbeSide& side : probes_.sides_of(s)) s_.certificate.open_atoms.push_back(side.from);
  }

  // Of a spherical patch; what it was chained from is not needed again.
  template <typename Patch>
  void list_faces(PatchFaces& faces, PatchKind kind, Patch& patch, std::uint32_t index, Numbers next) {
    patch.first_face = next.face;
    patch.face_count = faces.face_count;
    for (std::uint32_t f = 0; f < faces.face_count; ++f) {
      const std::uint32_t face = open_face(kind, index, next);
      for (std::size_t l = 0, h = 0; l < faces.loop_sizes.size(); h += faces.loop_sizes[l], ++l)
        if (faces.loop_face[l] == f)
          add_loop(face, {faces.half_borders.data() + h, faces.half_borders.data() + h + faces.loop_sizes[l]}, next);
    }
    const bool closed = faces.closed;
    faces = {};
    faces.closed = closed;
  }

  std::uint32_t open_face(PatchKind kind, std::uint32_t patch, Numbers& next) {
    Face& face = s_.faces[next.face];
    face.kind = kind;
    face.patch = patch;
    face.first_loop = next.loop;
    return next.face++;
  }

  void add_loop(std::uint32_t face, std::span<const HalfBorder> walk, Numbers& next) {
    s_.loops[next.loop++] = {next.half_border, static_cast<std::uint32_t>(walk.size())};
    std::ranges::copy(walk, s_.half_borders.begin() + next.half_border);
    next.half_border += static_cast<std::uint32_t>(walk.size());
    ++s_.faces[face].loop_count;
    for (const HalfBorder h : walk) s_.borders[border_of(h)].face[h & 1] = face;
  }

  void list_toroidal_faces(std::uint32_t t, Numbers next) {
    ToroidalPatch& patch = s_.toroidal[t];
    const PatchBorders& b = patch_borders_[t];
    patch.first_face = next.face;
    patch.face_count = numbers_of(b).face;
    if (flat_) return;
    const HalfBorder bottom = b.contact(0) * 2, top = b.contact(1) * 2 + 1;
    if (!b.spindle) {
      const std::uint32_t face = open_face(PatchKind::toroidal, t, next);
      if (b.free) {
        add_loop(face, std::array{bottom}, next);
        add_loop(face, std::array{top}, next);
      } else {
        add_loop(face, std::array{bottom, b.edge(1) * 2, top, b.edge(0) * 2 + 1}, next);
      }
      return;
    }
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t face = open_face(PatchKind::toroidal, t, next);
      const HalfBorder contact = side ? top : bottom;
      if (b.free) {
        add_loop(face, std::array{contact}, next);
        s_.faces[face].tip = axis_vertex_[first_on_circle_[t]] + side;
      } else if (side == 0) {
        add_loop(face, std::array{contact, b.half_edge(1, 0) * 2, b.half_edge(0, 0) * 2 + 1}, next);
      } else {
        add_loop(face, std::array{contact, b.half_edge(0, 1) * 2 + 1, b.half_edge(1, 1) * 2}, next);
      }
    }
  }

  // Euler characteristic: vertices - borders with ends + sum over faces of (2 - loops); whole circles count nothing.
  void connect_components() {
    UnionFind joined(s_.faces.size());
    for (const Border& border : s_.borders) {
      if (border.face[0] == kNone || border.face[1] == kNone) {
        for (const std::uint32_t f : border.face)
          if (f != kNone) add_open_face(f);
        continue;
      }
      joined.unite(border.face[0], border.face[1]);
    }
    std::vector<std::uint32_t> number(s_.faces.size(), kNone);
    for (std::uint32_t f = 0; f < s_.faces.size(); ++f) {
      const std::uint32_t root = joined.find(f);
      if (number[root] == kNone) {
        number[root] = static_cast<std::uint32_t>(s_.components.size());
        s_.components.push_back({});
        s_.components.back().euler = 0;
      }
      Face& face = s_.faces[f];
      face.component = number[root];
      s_.components[face.component].euler += 2 - static_cast<int>(face.loop_count);
    }
    std::vector<std::uint32_t> component_of_vertex(s_.vertices.size(), kNone);
    for (const Border& border : s_.borders) {
      if (border.vertex[0] == kNone || border.face[0] == kNone) continue;
      const std::uint32_t component = s_.faces[border.face[0]].component;
      --s_.components[component].euler;
      for (const std::uint32_t v : border.vertex) {
        if (component_of_vertex[v] == kNone) ++s_.components[component].euler;
        component_of_vertex[v] = component;
      }
    }
  }

  void add_open_face(std::uint32_t f) {
    const Face& face = s_.faces[f];
    if (face.kind == PatchKind::convex) s_.certificate.open_atoms.push_back(s_.convex[face.patch].atom);
    if (face.kind == PatchKind::concave) add_open_probe(face.patch);
    if (face.kind == PatchKind::toroidal)
      for (std::uint32_t a : s_.toroidal[face.patch].atom) s_.certificate.open_atoms.push_back(a);
  }

  Surface& s_;
  const FixedProbes& probes_;
  const CuspParts& cusps_;
  const ReducedSurface& rs_;
  const bool flat_;  // probe radius 0: toroidal and concave patches have no area, convex patches meet directly
  std::vector<std::uint32_t> first_on_circle_;
  std::vector<std::uint32_t> axis_vertex_;  // per toroidal patch that is first on a spindle circle
  std::uint32_t triple_vertex_ = 0;
  std::uint32_t first_cusp_border_ = 0;
  std::vector<std::array<std::uint32_t, 2>> side_at_;  // toroidal patch, end -> side of the probe there
  std::vector<PatchBorders> patch_borders_;
  std::vector<PatchFaces> convex_faces_;
  std::vector<PatchFaces> concave_faces_;
};

}  // namespace

void build_boundary(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs) {
  BoundaryBuilder(surface, probes, cusps, rs).run();
}

}  // namespace meniscus
